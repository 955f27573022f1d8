// SPDX-License-Identifier: MIT
// Shader programs and vertex buffers, owned.
#pragma once

#include <cstddef>
#include <string>

#include <epoxy/gl.h>
#include <glm/glm.hpp>

namespace tetmend::viewer::gl {

/// A linked shader program. Needs a current context, as everything in this folder.
class Program {
 public:
  /// @throws Error with the compiler's log.
  Program(const char* vertex, const char* fragment);
  ~Program() { glDeleteProgram(id_); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { glUseProgram(id_); }
  void set(const char* name, float value) const;
  void set(const char* name, const glm::vec2& value) const;
  void set(const char* name, const glm::vec3& value) const;
  void set(const char* name, const glm::mat4& value) const;

 private:
  GLint place(const char* name) const { return glGetUniformLocation(id_, name); }

  GLuint id_ = 0;
};

/// One attribute of a vertex, in the order of shader locations.
struct Attribute {
  GLint size;
  GLenum type;
  GLboolean normalized;
  bool integer;
  std::size_t offset;
};

/// A vertex array with one buffer.
class Buffer {
 public:
  /// `per_instance`: one element for each instance instead of for each vertex.
  Buffer(std::size_t stride, std::initializer_list<Attribute> attributes, bool per_instance);
  ~Buffer();
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  void fill(const void* data, std::size_t count);
  /// As fill(), with room for more.
  void fill_with_room(const void* data, std::size_t count);
  /// Writes the elements [first, first + count) of `data` again.
  void rewrite(const void* data, std::size_t first, std::size_t count);
  /// How many elements are drawn from now on. False if there is no room for them.
  bool resize(std::size_t count);
  std::size_t count() const { return count_; }
  void bind() const { glBindVertexArray(array_); }

 private:
  GLuint array_ = 0;
  GLuint buffer_ = 0;
  std::size_t stride_ = 0;
  std::size_t count_ = 0;
  std::size_t room_ = 0;
};

}  // namespace tetmend::viewer::gl
