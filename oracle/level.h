#pragma once

namespace rastercheck::oracle {

/// A level of the cascade (docs/oracle.md).
enum class Level { filter, interval, exact };

}  // namespace rastercheck::oracle
