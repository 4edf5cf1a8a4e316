#pragma once

// Owning wrappers for GL objects, and GL errors as values.

#include <epoxy/gl.h>

#include <string>
#include <utility>

#include "cases/error.h"

namespace rastercheck::backends::gl {

/// Owns a GL object's name. The context must be current when the owner is destroyed.
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

/// For OpenGL 3.3 and OpenGL ES: generates a name, whose object is created at its first binding.
Object generate_buffer();
Object generate_framebuffer();
Object generate_texture();
Object generate_vertex_array();

/// Returns a linked program, or the message of the compiler or linker.
Result<Object> make_program(const char* vertex_shader, const char* fragment_shader);

/// An error of the driver, in one line.
tl::unexpected<Error> failure(std::string reason);

/// Something that the driver does not support, in one line.
tl::unexpected<Error> unsupported(std::string reason);

/// Fails with the first error that GL recorded since the last call: "`what` failed (GL error 0x…)".
Result<void> check(const std::string& what);

/// Formats the code, as in "0x502".
std::string hexadecimal(GLenum code);

}  // namespace rastercheck::backends::gl
