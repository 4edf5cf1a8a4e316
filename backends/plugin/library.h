#pragma once

#include <string>

#include "backends/plugin/plugin.h"
#include "cases/capabilities.h"
#include "cases/contract.h"
#include "cases/error.h"

namespace rastercheck::backends {

/// A loaded plugin, with its structs completed and checked. It stays loaded.
struct Plugin {
  std::string name;
  std::string version;
  rastercheck_contract contract{};
  uint32_t (*draw)(const rastercheck_draw*, rastercheck_output*) = nullptr;
  uint32_t (*query)(const rastercheck_query*,
                    rastercheck_answer*) = nullptr;  ///< null if it has none
  uint32_t (*draw_picture)(const rastercheck_draw*, const rastercheck_pipeline*,
                           rastercheck_picture*) = nullptr;  ///< null if it has none
};

/// Loads a shared library and gets its plugin. Fails as `refused` if the file does not exist, and
/// as `unavailable` if it is no plugin, has another ABI or has an impossible contract. The error's
/// file is `plugin:` and the path.
Result<Plugin> load_plugin(const std::string& path);

/// Completes and checks the result of rastercheck_plugin_get(). Fails as `unavailable`.
Result<Plugin> checked_plugin(const rastercheck_plugin* theirs, const std::string& path);

/// The promise that a checked contract makes for a case.
cases::Contract contract_of(const rastercheck_contract& contract, const cases::Case& c);

/// The cases that a plugin with this contract draws.
cases::Capabilities capabilities_of(const rastercheck_contract& contract);

/// Names the feature of a case that the plugin lacks; empty if it draws the case.
std::string lacks(const rastercheck_contract& contract, const cases::Case& c);

/// Describes a plugin in one line, such as "little 1.0: coverage snapped to 8 subpixel bits, …".
std::string describe(const Plugin& plugin);

}  // namespace rastercheck::backends
