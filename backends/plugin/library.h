#pragma once

#include <string>

#include "backends/plugin/plugin.h"
#include "cases/capabilities.h"
#include "cases/contract.h"
#include "cases/error.h"

namespace rastercheck::backends {

/// A plugin that was loaded, its structs completed and checked. It stays loaded.
struct Plugin {
  std::string name;
  std::string version;
  rastercheck_contract contract{};
  uint32_t (*draw)(const rastercheck_draw*, rastercheck_output*) = nullptr;
};

/// Loads a shared library and asks it for its plugin. Fails as `refused` where there is no such
/// file, as `unavailable` where it is no plugin, or one of another ABI or with a contract that says
/// what cannot be. The error's file is `plugin:` and the path.
Result<Plugin> load_plugin(const std::string& path);

/// What rastercheck_plugin_get() returned, completed and checked; fails as `unavailable`.
Result<Plugin> checked_plugin(const rastercheck_plugin* theirs, const std::string& path);

/// What a contract that was checked promises of a case.
cases::Contract contract_of(const rastercheck_contract& contract, const cases::Case& c);

/// Which cases it draws.
cases::Capabilities capabilities_of(const rastercheck_contract& contract);

/// What of a case it lacks, in words; empty where it draws the case.
std::string lacks(const rastercheck_contract& contract, const cases::Case& c);

/// One line: "little 1.0: coverage snapped to 8 subpixel bits, …".
std::string describe(const Plugin& plugin);

}  // namespace rastercheck::backends
