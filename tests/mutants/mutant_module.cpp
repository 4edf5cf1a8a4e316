// Part of every mutant, with the damaged rasterizer and the backends that draw with it: the one
// function that its module exports.

#include "backends/backend.h"
#include "backends/factory.h"

/// Makes the backend of a specification as the program itself does, of the damaged sources; null
/// where there is none. The caller deletes it. Its virtual functions, the destructor among them,
/// are the module's.
extern "C" __attribute__((visibility("default"))) rastercheck::backends::Backend*
rastercheck_make_mutant(const char* specification) {
  auto backend = rastercheck::backends::make_backend(specification);
  return backend ? backend->release() : nullptr;
}
