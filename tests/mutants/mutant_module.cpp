// Compiled into every mutant, with the damaged rasterizer and its backend: the one function that
// its module exports. RASTERCHECK_MUTANT_METHOD is the textbook method that the patch damages,
// empty where that is the rasterizer proper; RASTERCHECK_MUTANT_PRECISION, …_OUTPUT and …_THREADS
// how it draws, as backends::RasterizerOptions has it.

#include "backends/backend.h"
#include "backends/cpu/rasterizer_backend.h"

/// The caller deletes it. Its virtual functions, the destructor among them, are the module's.
extern "C" __attribute__((visibility("default"))) rastercheck::backends::Backend*
rastercheck_make_mutant() {
  using rastercheck::backends::Output;
  using rastercheck::rasterizer::Precision;
  return rastercheck::backends::make_rasterizer_backend(
             {RASTERCHECK_MUTANT_METHOD, Precision::RASTERCHECK_MUTANT_PRECISION,
              Output::RASTERCHECK_MUTANT_OUTPUT, RASTERCHECK_MUTANT_THREADS})
      .release();
}
