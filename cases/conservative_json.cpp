#include "cases/conservative_json.h"

#include <fmt/format.h>

#include "cases/names.h"

namespace rastercheck::cases {

namespace {

/// One line about members that inner coverage cannot have.
void check_inner(const JsonNode& node, const Conservative& conservative) {
  if (node.failed() || conservative.kind != ConservativeKind::inner) return;
  if (conservative.growth > 0) {
    node["growth"].refuse("must be 0 for inner coverage, which never grows");
  } else if (conservative.corners == ConservativeCorners::edges) {
    node["corners"].refuse("must be \"square\" for inner coverage");
  } else if (conservative.covers_degenerates) {
    node["covers_degenerates"].refuse(
        "must be false for inner coverage: no pixel lies in a triangle without area");
  }
}

}  // namespace

std::optional<Conservative> read_conservative(const JsonNode& node) {
  if (node.is_string()) {
    if (node.text() != "none") node.refuse("must be \"none\" or an object with a kind");
    return std::nullopt;
  }
  node.expect_object({"kind"}, {"error", "growth", "corners", "covers_degenerates"});
  Conservative conservative;
  conservative.kind = node["kind"].enumerator<ConservativeKind>();
  const auto pixels = [&node](std::string_view key) {
    return node.has(key) ? node[key].float32(0, kMaxConservativeReach) : 0;
  };
  conservative.error = pixels("error");
  conservative.growth = pixels("growth");
  if (node.has("corners")) {
    conservative.corners = node["corners"].enumerator<ConservativeCorners>();
  }
  if (node.has("covers_degenerates")) {
    conservative.covers_degenerates = node["covers_degenerates"].boolean();
  }
  check_inner(node, conservative);
  return conservative;
}

std::string conservative_text(const std::optional<Conservative>& conservative) {
  if (!conservative) return "\"none\"";
  const auto& [kind, error, growth, corners, covers_degenerates] = *conservative;
  // The shortest digits that read back as the same double, and so the same float32.
  return fmt::format(
      R"({{"kind": "{}", "error": {}, "growth": {}, "corners": "{}", "covers_degenerates": {}}})",
      name_of(kind), double{error}, double{growth}, name_of(corners), covers_degenerates);
}

}  // namespace rastercheck::cases
