// The one function that a mutant's module exports. Every module contains this file, the damaged
// rasterizer, and the backends that draw with it.

#include "backends/backend.h"
#include "backends/factory.h"

/// Makes the backend of a specification as the program itself does, but from the damaged sources;
/// null if no such backend exists. The caller deletes the backend, whose virtual functions,
/// including the destructor, are the module's code.
extern "C" __attribute__((visibility("default"))) rastercheck::backends::Backend*
rastercheck_make_mutant(const char* specification) {
  auto backend = rastercheck::backends::make_backend(specification);
  return backend ? backend->release() : nullptr;
}
