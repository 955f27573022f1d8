// SPDX-License-Identifier: MIT
#include "viewer/gl/program.h"

#include <glm/gtc/type_ptr.hpp>

#include "kernel/error.h"

namespace tetmend::viewer::gl {

namespace {

GLuint compile(GLenum kind, const char* text) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint ok = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok != 0) return shader;
  std::string log(4096, '\0');
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw Error(std::string("the graphics driver refuses a shader: ") + log.c_str());
}

}  // namespace

Program::Program(const char* vertex, const char* fragment) : id_(glCreateProgram()) {
  for (const GLuint shader :
       {compile(GL_VERTEX_SHADER, vertex), compile(GL_FRAGMENT_SHADER, fragment)}) {
    glAttachShader(id_, shader);
    glDeleteShader(shader);  // stays until the program goes
  }
  glLinkProgram(id_);
  GLint ok = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &ok);
  if (ok == 0) throw Error("the graphics driver cannot link a shader program");
}

void Program::set(const char* name, float value) const {
  glUniform1f(place(name), value);
}
void Program::set(const char* name, const glm::vec2& value) const {
  glUniform2fv(place(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::vec3& value) const {
  glUniform3fv(place(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat4& value) const {
  glUniformMatrix4fv(place(name), 1, GL_FALSE, glm::value_ptr(value));
}

Buffer::Buffer(std::size_t stride, std::initializer_list<Attribute> attributes, bool per_instance)
    : stride_(stride) {
  glGenVertexArrays(1, &array_);
  glGenBuffers(1, &buffer_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  GLuint location = 0;
  for (const Attribute& a : attributes) {
    const auto* offset = reinterpret_cast<const void*>(a.offset);  // as OpenGL wants it
    const auto step = static_cast<GLsizei>(stride);
    if (a.integer) {
      glVertexAttribIPointer(location, a.size, a.type, step, offset);
    } else {
      glVertexAttribPointer(location, a.size, a.type, a.normalized, step, offset);
    }
    glEnableVertexAttribArray(location);
    if (per_instance) glVertexAttribDivisor(location, 1);
    ++location;
  }
}

Buffer::~Buffer() {
  glDeleteBuffers(1, &buffer_);
  glDeleteVertexArrays(1, &array_);
}

void Buffer::fill(const void* data, std::size_t count) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * stride_), data, GL_STATIC_DRAW);
  count_ = room_ = count;
}

void Buffer::fill_with_room(const void* data, std::size_t count) {
  constexpr std::size_t kLeast = 3000;
  room_ = count + count / 8 + kLeast;
  count_ = count;
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(room_ * stride_), nullptr, GL_DYNAMIC_DRAW);
  rewrite(data, 0, count);
}

void Buffer::rewrite(const void* data, std::size_t first, std::size_t count) {
  if (count == 0) return;
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(first * stride_),
                  static_cast<GLsizeiptr>(count * stride_),
                  static_cast<const std::byte*>(data) + first * stride_);
}

bool Buffer::resize(std::size_t count) {
  if (count > room_) return false;
  count_ = count;
  return true;
}

}  // namespace tetmend::viewer::gl
