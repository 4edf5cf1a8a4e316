#pragma once

// GL's objects with owners, and GL's errors as values.

#include <epoxy/gl.h>

#include <string>
#include <utility>

#include "cases/error.h"

namespace rastercheck::backends::gl {

/// A GL object's name, deleted with its owner while the context is current.
class Object {
 public:
  using Delete = void (*)(GLuint name) noexcept;

  Object() = default;
  Object(GLuint name, Delete remove) : name_(name), delete_(remove) {}
  Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)), delete_(other.delete_) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(delete_, other.delete_);
    return *this;
  }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() {
    if (name_ != 0) delete_(name_);
  }

  GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
  Delete delete_ = nullptr;
};

Object make_buffer();
Object make_framebuffer();
Object make_sampler();
/// `target`: GL_TEXTURE_2D or GL_TEXTURE_2D_MULTISAMPLE.
Object make_texture(GLenum target);
Object make_vertex_array();

/// The same for OpenGL 3.3 and OpenGL ES: names of what comes to be where it is bound first.
Object generate_buffer();
Object generate_framebuffer();
Object generate_texture();
Object generate_vertex_array();

/// A linked program, or what the compiler or the linker said.
Result<Object> make_program(const char* vertex_shader, const char* fragment_shader);

/// An error of drivers, in one line.
tl::unexpected<Error> failure(std::string reason);

/// The first error that GL noted since the last call, as "`what` failed (GL error 0x…)".
Result<void> check(const std::string& what);

/// "0x502"
std::string hexadecimal(GLenum code);

}  // namespace rastercheck::backends::gl
