// SPDX-License-Identifier: MIT
// The shaders, as text.
#pragma once

namespace tetmend::viewer::gl {

// One triangle that covers all.
inline constexpr const char* kBackgroundVertex = R"glsl(#version 330 core
out float height;
void main() {
  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  height = (p.y + 1.0) / 2.0;
  gl_Position = vec4(p, 0.0, 1.0);
}
)glsl";

inline constexpr const char* kBackgroundFragment = R"glsl(#version 330 core
uniform vec3 low;
uniform vec3 high;
in float height;
out vec4 colour;
void main() { colour = vec4(mix(low, high, height), 1.0); }
)glsl";

inline constexpr const char* kSurfaceVertex = R"glsl(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 tint;
layout(location = 2) in vec3 normal;
layout(location = 3) in uint edge_bits;
uniform mat4 view;
uniform mat4 projection;
flat out vec4 face_tint;
flat out vec3 face_normal;
flat out uint drawn;
out vec3 corner;
void main() {
  int i = gl_VertexID % 3;
  corner = vec3(i == 0, i == 1, i == 2);
  face_tint = tint;
  face_normal = mat3(view) * normal;
  drawn = edge_bits;
  gl_Position = projection * (view * vec4(position, 1.0));
}
)glsl";

// Two soft lights that move with the camera. Edges are where a barycentric coordinate is small;
// they fade where triangles get as small as the lines.
inline constexpr const char* kSurfaceFragment = R"glsl(#version 330 core
flat in vec4 face_tint;
flat in vec3 face_normal;
flat in uint drawn;
in vec3 corner;
uniform float opacity;
uniform float edges;
uniform float line_width;
uniform float scale;
uniform vec3 edge_tint;
out vec4 colour;
void main() {
  vec3 n = normalize(face_normal);
  if (!gl_FrontFacing) n = -n;
  float key = max(dot(n, normalize(vec3(-0.35, 0.55, 0.75))), 0.0);
  float fill = max(dot(n, normalize(vec3(0.6, -0.2, 0.6))), 0.0);
  vec3 lit = face_tint.rgb * (0.54 + 0.40 * key + 0.14 * fill);
  if (!gl_FrontFacing) lit *= 0.75;
  vec3 step_ = fwidth(corner);
  vec3 cover = 1.0 - smoothstep(step_ * (line_width - 0.5), step_ * (line_width + 0.5), corner);
  cover *= vec3((drawn & 1u) != 0u, (drawn & 2u) != 0u, (drawn & 4u) != 0u);
  float largest = max(step_.x, max(step_.y, step_.z)) * scale;
  float fade = 1.0 - smoothstep(0.04, 0.32, largest);
  float line = edges * fade * max(cover.x, max(cover.y, cover.z));
  colour = vec4(mix(lit, edge_tint, line), opacity * face_tint.a);
}
)glsl";

// Glass: clear where it faces the eye, denser at the rim. From the corners and normals of a surface.
inline constexpr const char* kOutlineFragment = R"glsl(#version 330 core
flat in vec3 face_normal;
uniform vec3 tint;
out vec4 colour;
void main() {
  float slant = 1.0 - abs(normalize(face_normal).z);
  colour = vec4(tint, 0.06 + 0.22 * slant * slant);
}
)glsl";

// Each instance is a line, drawn as a rectangle of constant width on the screen.
inline constexpr const char* kLineVertex = R"glsl(#version 330 core
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 tint;
layout(location = 3) in float width;
uniform mat4 view;
uniform mat4 projection;
uniform vec2 canvas;
uniform float scale;
flat out vec4 line_tint;
void main() {
  vec4 a = projection * (view * vec4(from, 1.0));
  vec4 b = projection * (view * vec4(to, 1.0));
  float tiny = 1e-6 * max(abs(a.w), abs(b.w));
  if (a.w < tiny && b.w > tiny) a = mix(b, a, (b.w - tiny) / (b.w - a.w));
  if (b.w < tiny && a.w > tiny) b = mix(a, b, (a.w - tiny) / (a.w - b.w));
  vec2 along = (b.xy / b.w - a.xy / a.w) * canvas;
  along = dot(along, along) > 1e-12 ? normalize(along) : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  bool at_end = gl_VertexID >= 2;
  vec4 p = at_end ? b : a;
  vec2 offset = (at_end ? along : -along) + ((gl_VertexID & 1) == 0 ? across : -across);
  p.xy += offset * (scale * width / canvas) * p.w;
  line_tint = tint;
  gl_Position = p;
}
)glsl";

inline constexpr const char* kLineFragment = R"glsl(#version 330 core
flat in vec4 line_tint;
out vec4 colour;
void main() { colour = line_tint; }
)glsl";

}  // namespace tetmend::viewer::gl
