// Compiled into every mutant, with a mutated copy of the rasterizer and of its backend: the one
// function that its module exports.

#include "backends/backend.h"
#include "backends/cpu/rasterizer_backend.h"

/// The caller deletes it. Its virtual functions, the destructor among them, are the module's.
extern "C" __attribute__((visibility("default"))) rastercheck::backends::Backend*
rastercheck_make_mutant() {
  return rastercheck::backends::make_rasterizer_backend("").release();
}
