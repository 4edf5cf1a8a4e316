#pragma once

namespace rastercheck::bench {

/// Adds the benchmarks raster/METHOD/random_72px, one for each textbook method: to be called when
/// all have registered themselves, from main().
void register_methods();

}  // namespace rastercheck::bench
