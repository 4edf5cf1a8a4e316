#include "cases/importers/shader_test_shader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>

#include "cases/json.h"

namespace rastercheck::cases::shader_test_importer {
namespace {

/// A test has a dozen; the bound is for those that search them all.
constexpr std::size_t kMaxGlobals = 1000;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The length of the token that a text begins with.
std::size_t token_length(std::string_view text) {
  const char first = text.front();
  std::size_t end = 1;
  if (is_letter(first)) {
    while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
  } else if (is_digit(first) || (first == '.' && text.size() > 1 && is_digit(text[1]))) {
    const auto continues = [&](std::size_t i) {
      const bool is_sign = (text[i] == '+' || text[i] == '-') &&
                           (text[i - 1] == 'e' || text[i - 1] == 'E') && !text.starts_with("0x");
      return is_letter(text[i]) || is_digit(text[i]) || text[i] == '.' || is_sign;
    };
    while (end < text.size() && continues(end)) ++end;
  } else if (text.size() > 1 && std::string_view("=+-*/<>!").find(first) != text.npos &&
             (text[1] == '=' || (text[1] == first && (first == '+' || first == '-')))) {
    end = 2;
  }
  return end;
}

/// The tokens of a shader without those of its preprocessor lines.
class Lexer {
 public:
  explicit Lexer(bool allows_directives) : allows_directives_(allows_directives) {}

  std::optional<Refusal> read(const SourceLine& line) {
    std::string_view rest = line.text;
    std::vector<Token>* to = &tokens;
    while (!rest.empty()) {
      if (is_in_comment_) {
        const std::size_t end = rest.find("*/");
        is_in_comment_ = end == std::string_view::npos;
        rest.remove_prefix(is_in_comment_ ? rest.size() : end + 2);
      } else if (rest.starts_with("/*")) {
        is_in_comment_ = true;
        rest.remove_prefix(2);
      } else if (rest.starts_with("//")) {
        break;
      } else if (rest.front() == '#') {
        rest.remove_prefix(1);
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
        const std::string_view word = rest.substr(0, rest.empty() ? 0 : token_length(rest));
        if (is_among(word, {"version", "extension", "pragma", "line", ""})) break;
        if (!allows_directives_ || rest.find('\\') != std::string_view::npos) {
          return Refusal{line.number, fmt::format("#{} is not understood", printable(word))};
        }
        has_condition = has_condition || word.starts_with("if");
        rest.remove_prefix(word.size());
        to = &directives;
      } else if (std::string_view(" \t\r\f\v").find(rest.front()) != std::string_view::npos) {
        rest.remove_prefix(1);
      } else {
        const std::size_t length = token_length(rest);
        to->push_back({rest.substr(0, length), line.number});
        rest.remove_prefix(length);
      }
    }
    return std::nullopt;
  }

  std::vector<Token> tokens;
  std::vector<Token> directives;
  bool has_condition = false;

 private:
  bool allows_directives_;
  bool is_in_comment_ = false;
};

/// True if two declarations of one name do not agree, as in the branches of an #if.
bool is_contradicted(const std::vector<Global>& globals) {
  for (const Global& global : globals) {
    const auto first = std::find_if(globals.begin(), globals.end(),
                                    [&](const Global& one) { return one.name == global.name; });
    if (first->interpolation != global.interpolation || first->location != global.location ||
        first->storage != global.storage) {
      return true;
    }
  }
  return false;
}

/// Reads the qualifiers of a declaration from its beginning; returns how many tokens they are.
std::size_t read_qualifiers(Tokens tokens, bool is_fragment, Global& global) {
  std::size_t i = 0;
  for (; i < tokens.size(); ++i) {
    const std::string_view word = tokens[i].text;
    if (word == "layout" && i + 1 < tokens.size()) {
      const std::size_t end = closing(tokens, i + 1);
      for (std::size_t k = i; k + 2 < end; ++k) {
        if (tokens[k].text == "location" && tokens[k + 1].text == "=")
          global.slot = integer(tokens[k + 2].text);
      }
      i = std::min(end, tokens.size() - 1);
    } else if (word == "attribute") {
      global.storage = "in";
    } else if (word == "varying") {
      global.storage = is_fragment ? "in" : "out";
    } else if (is_among(word, {"in", "out", "uniform", "const", "buffer", "shared"})) {
      global.storage = word;
    } else if (word == "flat") {
      global.interpolation = Interpolation::flat;
    } else if (word == "noperspective") {
      global.interpolation = Interpolation::noperspective;
    } else if (word == "smooth") {
      global.interpolation = Interpolation::smooth;
    } else if (word == "centroid") {
      global.location = Location::centroid;
    } else if (word == "sample") {
      global.location = Location::sample;
    } else if (!is_among(word, {"invariant", "precise", "highp", "mediump", "lowp", "coherent",
                                "readonly", "writeonly", "volatile", "restrict", "patch"})) {
      break;
    }
  }
  return i;
}

/// Adds the variables that a declaration names, without its semicolon.
void add_globals(Tokens tokens, bool is_fragment, std::vector<Global>& globals) {
  Global global;
  std::size_t i = read_qualifiers(tokens, is_fragment, global);
  // "invariant gl_Position" has no type, and "precision mediump float" no name.
  if (i + 1 >= tokens.size() || tokens[i].text == "precision") return;
  global.type = tokens[i++].text;
  const bool is_type_array = tokens[i].text == "[";
  if (is_type_array) i = closing(tokens, i) + 1;
  while (i < tokens.size()) {
    global.name = tokens[i].text;
    global.line = tokens[i].line;
    global.is_array = is_type_array || (i + 1 < tokens.size() && tokens[i + 1].text == "[");
    if (is_name(global.name)) globals.push_back(global);
    // A comma between brackets belongs to an initialiser.
    while (i < tokens.size() && tokens[i].text != ",") {
      const bool opens = is_among(tokens[i].text, {"(", "[", "{"});
      i = opens ? closing(tokens, i) + 1 : i + 1;
    }
    ++i;
  }
}

bool has_parenthesis(Tokens tokens) {
  return std::any_of(tokens.begin(), tokens.end(), [](const Token& t) { return t.text == "("; });
}

}  // namespace

bool is_name(std::string_view text) { return !text.empty() && is_letter(text.front()); }

bool is_among(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

std::size_t closing(Tokens tokens, std::size_t open) {
  std::size_t depth = 0;
  for (std::size_t i = open; i < tokens.size(); ++i) {
    if (is_among(tokens[i].text, {"(", "[", "{"})) ++depth;
    if (is_among(tokens[i].text, {")", "]", "}"}) && --depth == 0) return i;
  }
  return tokens.size();
}

std::optional<int> integer(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

int components_of(std::string_view type) {
  if (type == "float") return 1;
  if (type.size() == 4 && type.starts_with("vec") && type[3] >= '2' && type[3] <= '4') {
    return type[3] - '0';
  }
  return 0;
}

const Global* Shader::find(std::string_view name) const {
  const auto found = std::find_if(globals.begin(), globals.end(),
                                  [&](const Global& global) { return global.name == name; });
  return found == globals.end() ? nullptr : &*found;
}

bool Shader::mentions(std::string_view name, std::size_t times) const {
  const auto count = std::count_if(tokens.begin(), tokens.end(),
                                   [&](const Token& token) { return token.text == name; });
  return static_cast<std::size_t>(count) >= times;
}

Expected<Shader> read_shader(const std::vector<SourceLine>& source, bool is_fragment) {
  // Of a fragment shader only declarations matter, so that both branches of an #if may be read.
  Lexer lexer(is_fragment);
  for (const SourceLine& line : source) {
    if (const auto refusal = lexer.read(line)) return tl::unexpected(*refusal);
  }
  Shader shader;
  shader.tokens = std::move(lexer.tokens);
  const Tokens all = shader.tokens;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string_view word = all[i].text;
    if (word == "(" || word == "[") {
      i = std::min(closing(all, i), all.size() - 1);
      continue;
    }
    if (word != "{" && word != ";") continue;
    const Tokens head = all.subspan(begin, i - begin);
    Global unused;
    const Tokens named = head.subspan(read_qualifiers(head, is_fragment, unused));
    const bool is_function = word == "{" && has_parenthesis(named);
    if (word == "{") {
      const std::size_t end = closing(all, i);
      if (is_function && named.size() > 1 && named[1].text == "main") {
        shader.main_line = named[1].line;
        shader.main.assign(all.begin() + static_cast<std::ptrdiff_t>(i + 1),
                           all.begin() + static_cast<std::ptrdiff_t>(end));
      }
      i = std::min(end, all.size() - 1);
      // A block ends with a semicolon, after the name of an instance; an initialiser likewise.
      if (!is_function) {
        while (i + 1 < all.size() && all[i].text != ";") ++i;
      }
    } else if (!has_parenthesis(named) ||
               std::any_of(named.begin(), named.end(),
                           [](const Token& token) { return token.text == "="; })) {
      add_globals(head, is_fragment, shader.globals);
    }
    begin = i + 1;
  }
  if (shader.globals.size() > kMaxGlobals ||
      (lexer.has_condition && is_contradicted(shader.globals))) {
    return tl::unexpected(
        Refusal{source.front().number, "the shader's declarations depend on #if, or are too many"});
  }
  // A name in a macro is mentioned.
  shader.tokens.insert(shader.tokens.end(), lexer.directives.begin(), lexer.directives.end());
  return shader;
}

}  // namespace rastercheck::cases::shader_test_importer
