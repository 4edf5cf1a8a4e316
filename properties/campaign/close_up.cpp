#include "properties/campaign/close_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

#include "cases/names.h"
#include "oracle/judge.h"
#include "oracle/transform.h"
#include "properties/drawing.h"

namespace rastercheck::properties {
namespace {

using records::FragmentClass;

/// Pixels shown on either side of the violation.
constexpr int kAcross = 7;
constexpr int kUpAndDown = 5;

struct Sign {
  char sign;
  std::string_view meaning;
};

constexpr Sign kRight{'#', "drawn correctly"};
constexpr Sign kEmpty{'.', "correctly not drawn"};
constexpr std::array kWrong{Sign{'-', "missing"}, Sign{'+', "drawn but must not be"},
                            Sign{'!', "drawn with a wrong value"}};

char sign_of(const oracle::JudgedSample& sample) {
  if (sample.fragment_class == FragmentClass::missing) return '-';
  if (sample.fragment_class != FragmentClass::correct) return '+';
  const bool is_right = std::all_of(sample.values.begin(), sample.values.end(), [](const auto& v) {
    return v.fragment_class == FragmentClass::correct;
  });
  return is_right ? kRight.sign : '!';
}

/// Pixels by (y, x).
using Signs = std::map<std::pair<int, int>, char>;

/// True if the sign at the violation's place agrees with the violation.
bool shows(char sign, const records::Violation& violation) {
  switch (violation.fragment_class) {
    case FragmentClass::missing:
      return sign == '-';
    case FragmentClass::extra:
    case FragmentClass::wrong_triangle:
      return sign == '+';
    default:
      return sign == '!';
  }
}

std::string_view triangle_of(cases::Basis basis) {
  switch (basis) {
    case cases::Basis::ideal:
      return "the ideal triangle";
    case cases::Basis::snapped:
      return "the snapped triangle";
    case cases::Basis::unspecified:
      break;
  }
  return "the ideal or the snapped triangle";
}

/// The precision that a contract promises: "8 subpixel bits, rounding half_up, values of the
/// snapped triangle".
std::string precision_text(const cases::Contract& contract) {
  if (!contract.coverage) return "exact coverage";
  const cases::Snapping& grid = *contract.coverage;
  const std::string spacing = grid.odd_steps == 1
                                  ? fmt::format("{} subpixel bits", grid.subpixel_bits)
                                  : fmt::format("{} grid points per pixel", grid.steps());
  return fmt::format("{}, rounding {}, values of {}", spacing, cases::name_of(grid.rounding),
                     triangle_of(contract.basis));
}

std::string legend_of(const Signs& signs, bool has_empty) {
  const auto occurs = [&signs](char sign) {
    return std::any_of(signs.begin(), signs.end(),
                       [sign](const auto& s) { return s.second == sign; });
  };
  std::string legend;
  const auto add = [&legend](const Sign& sign) {
    legend += fmt::format("{}{} {}", legend.empty() ? "" : "   ", sign.sign, sign.meaning);
  };
  if (occurs(kRight.sign)) add(kRight);
  if (has_empty) add(kEmpty);
  for (const Sign& sign : kWrong) {
    if (occurs(sign.sign)) add(sign);
  }
  return legend;
}

}  // namespace

std::vector<std::string> close_up(const cases::Case& c, backends::Backend& backend,
                                  const records::Violation& violation) {
  const Result<cases::ClipCase> clip = oracle::to_clip_case(c, "");
  if (!clip || violation.place.triangle >= clip->triangles.size()) return {};
  const Result<backends::Drawn> drawn = draw(*clip, backend);
  if (!drawn) return {};
  const cases::Contract& contract = drawn->contract;

  const auto x = static_cast<int>(violation.place.x);
  const auto y = static_cast<int>(violation.place.y);
  const int x0 = std::max(x - kAcross, 0);
  const int y0 = std::max(y - kUpAndDown, 0);
  const int x1 = std::min(x + kAcross + 1, clip->framebuffer.width);
  const int y1 = std::min(y + kUpAndDown + 1, clip->framebuffer.height);
  Signs signs;
  const oracle::SceneTruth scene(*clip, contract);
  oracle::judge(
      scene, drawn->fragments, {}, [&](const oracle::JudgedSample& sample, const auto* /*truth*/) {
        const auto at =
            std::pair(static_cast<int>(sample.place.y), static_cast<int>(sample.place.x));
        const bool is_shown = at.second >= x0 && at.second < x1 && at.first >= y0 && at.first < y1;
        if (!is_shown || sample.place.sample != violation.place.sample ||
            sample.place.triangle != violation.place.triangle)
          return;
        signs[at] = std::max(signs[at], sign_of(sample));
      });

  // A column has room for a sign in brackets and for its number.
  const std::size_t width = std::max<std::size_t>(std::to_string(x1 - 1).size() + 2, 4);
  std::vector<std::string> lines;
  bool has_empty = false;
  for (int row = y0; row < y1; ++row) {
    std::string line = fmt::format("y {:>5}  ", row);
    for (int column = x0; column < x1; ++column) {
      const auto found = signs.find({row, column});
      has_empty = has_empty || found == signs.end();
      const char sign = found == signs.end() ? kEmpty.sign : found->second;
      const bool is_it = row == y && column == x;
      line += fmt::format("{:>{}}{}{}", is_it ? '[' : ' ', width - 2, sign, is_it ? ']' : ' ');
    }
    lines.push_back(line);
  }
  std::string columns = "   x     ";
  for (int column = x0; column < x1; ++column) {
    columns += fmt::format("{:>{}} ", column, width - 1);
  }
  lines.push_back(columns);
  lines.push_back(legend_of(signs, has_empty));
  const auto it = signs.find({y, x});
  if (!shows(it == signs.end() ? kEmpty.sign : it->second, violation)) {
    lines.emplace_back(
        "The picture shows the original drawing; the property failed on a changed copy.");
  }
  const bool is_as_asked =
      contract.coverage == clip->coverage && (!clip->coverage || contract.basis == clip->basis);
  if (!is_as_asked) {
    lines.push_back(
        fmt::format("Judged by the backend's own precision: {}.", precision_text(contract)));
  }
  return lines;
}

}  // namespace rastercheck::properties
