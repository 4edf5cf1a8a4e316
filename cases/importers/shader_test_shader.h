#pragma once

// A shader of a piglit test as tokens: the variables that it declares, and the statements of
// main().

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "cases/case.h"

namespace rastercheck::cases::shader_test_importer {

/// A line of the file; lines are counted from 1.
struct SourceLine {
  std::size_t number = 0;
  std::string_view text;
};

/// Why something cannot become a case, and in which line.
struct Refusal {
  std::size_t line = 0;
  std::string reason;
};

template <typename T>
using Expected = tl::expected<T, Refusal>;

struct Token {
  std::string_view text;
  std::size_t line = 0;
};

/// A variable declared outside of functions.
struct Global {
  std::string_view name;
  std::string_view type;
  std::string_view storage;  ///< "in", "out", "uniform", "const" or empty
  std::optional<Interpolation> interpolation;
  std::optional<Location> location;
  std::optional<int> slot;  ///< layout(location = …)
  bool is_array = false;
  std::size_t line = 0;
};

/// The number of components of float, vec2, vec3 and vec4; 0 for other types.
int components_of(std::string_view type);

/// A shader taken apart. The texts are those of the source.
struct Shader {
  std::vector<Global> globals;
  std::vector<Token> tokens;  ///< without comments; those of preprocessor lines come last
  std::vector<Token> main;    ///< between the braces of main()
  std::size_t main_line = 0;  ///< 0 if there is no main()
  const Global* find(std::string_view name) const;
  /// True if a token of that name occurs so often, or more often.
  bool mentions(std::string_view name, std::size_t times = 1) const;
};

/// `is_fragment` decides what `varying` means, and allows for macros and conditions.
Expected<Shader> read_shader(const std::vector<SourceLine>& source, bool is_fragment);

using Tokens = std::span<const Token>;

/// True for names and words of the language.
bool is_name(std::string_view text);
bool is_among(std::string_view text, std::initializer_list<std::string_view> words);
/// The place of the bracket that closes the one at `open`; the end if none does.
std::size_t closing(Tokens tokens, std::size_t open);
/// The number that a text is as a whole.
std::optional<int> integer(std::string_view text);

}  // namespace rastercheck::cases::shader_test_importer
