#include "cases/importers/shader_test_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "cases/json.h"

namespace rastercheck::cases::shader_test_importer {
namespace {

/// Deeper nesting of expressions and statements is refused, so that the stack suffices.
constexpr int kMaxDepth = 64;

/// The nearest float32 of a literal.
std::optional<float> literal(std::string_view text) {
  if (text.ends_with('f') || text.ends_with('F')) text.remove_suffix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (std::fabs(value) > std::numeric_limits<float>::max()) return std::nullopt;
  return static_cast<float>(value);
}

/// An arithmetic operation on float32 numbers, and whether its result had to be rounded.
struct Rounded {
  float number = 0;
  bool is_rounded = false;
};

Rounded operate(std::string_view by, float a, float b) {
  const double wide_a = a;
  const double wide_b = b;
  if (by == "*") {
    const double product = wide_a * wide_b;  // exact: 48 bits
    const float number = a * b;
    return {number, double{number} != product};
  }
  if (by == "/") {
    const float number = a / b;
    return {number, double{number} * wide_b != wide_a};
  }
  if (by == "-") return operate("+", a, -b);
  const float sum = a + b;
  // If the sum is exact, either difference gives the other operand back. If it is not, the
  // difference with the larger operand is exact in double, and unequal to the smaller one.
  return {sum, double{sum} - wide_a != wide_b || double{sum} - wide_b != wide_a};
}

}  // namespace

/// Runs statements one after the other.
class Interpreter {
 public:
  Interpreter(const Shader& shader, const Inputs& inputs, bool has_projection, VertexRun& run)
      : shader_(&shader), inputs_(&inputs), has_projection_(has_projection), run_(&run) {}

  void execute(Tokens tokens) {
    tokens_ = tokens;
    at_ = 0;
    while (at_ < tokens_.size() && !has_returned_) statement();
  }

 private:
  std::string_view word(std::size_t ahead = 0) const {
    return at_ + ahead < tokens_.size() ? tokens_[at_ + ahead].text : std::string_view();
  }
  std::size_t line() const {
    return tokens_.empty() ? 0 : tokens_[std::min(at_, tokens_.size() - 1)].line;
  }
  bool take(std::string_view text) {
    if (word() != text) return false;
    ++at_;
    return true;
  }

  /// The first reason is kept.
  Value refuse(std::string reason) { return refuse(Refusal{line(), std::move(reason)}); }
  Value refuse(const Refusal& refusal) {
    if (!refusal_) refusal_ = refusal;
    return {};
  }

  bool is_input(std::string_view name) const {
    if (name == "gl_Vertex" || name == "gl_MultiTexCoord0") return true;
    const Global* global = shader_->find(name);
    return global != nullptr && global->storage == "in";
  }

  /// Takes the value from each variable that occurs: nobody knows what a branch leaves in it.
  void doubt(Tokens doubted, const std::string& reason) {
    for (const Token& token : doubted) {
      if (!is_name(token.text) || is_input(token.text)) continue;
      run_->refused_.insert_or_assign(std::string(token.text), Refusal{token.line, reason});
      if (token.text == "return") may_have_returned_ = Refusal{token.line, reason};
    }
  }

  void statement() {
    const std::size_t begin = at_;
    statement_ = begin;
    refusal_.reset();
    if (is_among(word(), {"if", "for", "while", "do", "switch", "{"})) {
      const std::string reason = word() == "{" ? std::string("may be changed in a block")
                                               : fmt::format("may be changed by '{}'", word());
      skip_statement(0);
      doubt(tokens_.subspan(begin, at_ - begin), reason);
    } else if (word() == "return") {
      has_returned_ = true;
    } else if (!take(";")) {
      const std::size_t end = end_of_simple();
      if (!declaration(end) && !assignment(end)) {
        at_ = begin;
        doubt(tokens_.subspan(begin, end - begin),
              fmt::format("may be changed by '{}…', which is not understood", printable(word())));
      }
      at_ = std::min(end + 1, tokens_.size());
    }
  }

  /// The semicolon of a statement without a body.
  std::size_t end_of_simple() const {
    std::size_t end = at_;
    while (end < tokens_.size() && tokens_[end].text != ";") ++end;
    return end;
  }

  void skip_statement(int depth) {
    if (depth > kMaxDepth) {
      at_ = tokens_.size();
    } else if (word() == "{") {
      at_ = std::min(closing(tokens_, at_) + 1, tokens_.size());
    } else if (is_among(word(), {"if", "for", "while", "switch"})) {
      ++at_;
      at_ = std::min(closing(tokens_, at_) + 1, tokens_.size());
      skip_statement(depth + 1);
      if (take("else")) skip_statement(depth + 1);
    } else if (take("do")) {
      skip_statement(depth + 1);
      at_ = std::min(end_of_simple() + 1, tokens_.size());
    } else {
      at_ = std::min(end_of_simple() + 1, tokens_.size());
    }
  }

  /// "vec4 a = …, b": all but an assignment's own names are locals.
  bool declaration(std::size_t end) {
    while (is_among(word(), {"const", "highp", "mediump", "lowp", "precise"})) ++at_;
    if (!is_name(word()) || !is_name(word(1))) return false;
    const std::string_view type = word();
    ++at_;
    while (at_ < end) {
      const std::string name(word());
      const std::size_t name_line = line();
      ++at_;
      refusal_.reset();
      Value value;
      value.count = std::max(components_of(type), 1);
      if (components_of(type) == 0 || word() == "[") {
        refuse(fmt::format("'{}' is no float or vector of floats", printable(name)));
      } else if (shader_->find(name) != nullptr) {
        refuse(fmt::format("'{}' is declared twice", printable(name)));
      } else if (take("=")) {
        const Value initial = expression(0);
        if (!refusal_ && initial.count != value.count) refuse("is a value of another type");
        value = initial;
        value.is_integer = false;
      }
      if (!refusal_ && at_ < end && word() != ",") refuse("is not understood");
      keep(name, value, name_line);
      if (refusal_) doubt_effects(end);
      while (at_ < end && !take(",")) ++at_;
    }
    return true;
  }

  /// Doubts what the rest of a statement may change that could not be understood.
  void doubt_effects(std::size_t end) {
    const Tokens rest = tokens_.subspan(statement_, end - statement_);
    std::size_t assignments = 0;
    bool has_effects = false;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const std::string_view text = rest[i].text;
      if (is_among(text, {"=", "+=", "-=", "*=", "/="})) ++assignments;
      const bool is_call =
          i > 0 && text == "(" && is_name(rest[i - 1].text) && components_of(rest[i - 1].text) == 0;
      has_effects = has_effects || is_call || is_among(text, {"++", "--"});
    }
    if (!has_effects && assignments < 2) return;
    doubt(rest, refusal_->reason);
    at_ = end;
  }

  void keep(const std::string& name, const Value& value, std::size_t at_line) {
    if (!refusal_ && may_have_returned_) refuse(*may_have_returned_);
    if (refusal_) {
      run_->refused_.insert_or_assign(name.substr(0, name.find('[')),
                                      Refusal{at_line, refusal_->reason});
      return;
    }
    run_->refused_.erase(name);
    run_->values_.insert_or_assign(name, value);
  }

  /// The components that a variable has by its declaration; 0 if unknown.
  int declared_components(std::string_view name) const {
    if (const Global* global = shader_->find(name)) return components_of(global->type);
    if (is_among(name, {"gl_ClipDistance", "gl_PointSize", "gl_FogFragCoord"})) return 1;
    if (is_among(name, {"gl_Position", "gl_ClipVertex", "gl_TexCoord", "gl_FrontColor",
                        "gl_BackColor", "gl_FrontSecondaryColor", "gl_BackSecondaryColor"})) {
      return 4;
    }
    const auto local = run_->values_.find(name);
    return local == run_->values_.end() ? 0 : local->second.count;
  }
  bool is_array(std::string_view name) const {
    const Global* global = shader_->find(name);
    return global != nullptr ? global->is_array
                             : name == "gl_ClipDistance" || name == "gl_TexCoord";
  }

  /// The element of an array that comes next, as text; empty if there is none.
  std::string index() {
    if (word() != "[" || word(2) != "]" || !integer(word(1))) return "";
    const std::string text = fmt::format("[{}]", *integer(word(1)));
    at_ += 3;
    return text;
  }

  bool assignment(std::size_t end) {
    if (!is_name(word())) return false;
    const std::string root(word());
    const std::size_t begin = line();
    ++at_;
    std::string name = root;
    if (is_array(root)) name += index();
    if (is_array(root) && name == root) return false;
    std::vector<int> components;
    if (take(".")) components = swizzle();
    const std::string_view by = word();
    if (refusal_ || !is_among(by, {"=", "+=", "-=", "*=", "/="})) return false;
    ++at_;
    Value value = expression(0);
    if (!refusal_ && at_ != end) refuse("is not understood");
    const int declared = declared_components(root);
    if (!refusal_ && declared == 0) {
      refuse(
          fmt::format("'{}' is no float or vector of floats that is known here", printable(root)));
    }
    if (!refusal_ && by != "=") {
      Value before = read(name, root);
      before = components.empty() ? checked(before) : chosen(before, components);
      value = combined(by.substr(0, 1), before, value);
    }
    store(name, declared, components, value, begin);
    if (refusal_) doubt_effects(end);
    return true;
  }

  void store(const std::string& name, int declared, const std::vector<int>& components,
             const Value& value, std::size_t begin) {
    Value whole;
    whole.count = declared;
    const auto known = run_->values_.find(name);
    if (!components.empty() && known != run_->values_.end()) whole = known->second;
    const int wanted = components.empty() ? declared : static_cast<int>(components.size());
    if (!refusal_ && value.count != wanted) refuse("is a value of another type");
    if (!refusal_ && !components.empty()) {
      const auto doubted = run_->refused_.find(name);
      if (doubted != run_->refused_.end()) refuse(doubted->second);
      if (value.is_projected || whole.is_projected) refuse("takes the projection apart");
    }
    for (int i = 0; i < wanted && !refusal_; ++i) {
      const int to = components.empty() ? i : components[static_cast<std::size_t>(i)];
      if (to >= declared) {
        refuse("has no such component");
        break;
      }
      whole.numbers.at(static_cast<std::size_t>(to)) =
          value.numbers.at(static_cast<std::size_t>(i));
      whole.defined |= 1U << static_cast<unsigned>(to);
    }
    whole.is_rounded = whole.is_rounded || value.is_rounded;
    whole.is_projected = value.is_projected;
    keep(name, whole, begin);
  }

  std::vector<int> swizzle() {
    std::vector<int> components;
    const std::string_view letters = word();
    for (const std::string_view set : {"xyzw", "rgba", "stpq"}) {
      components.clear();
      for (const char c : letters) {
        const std::size_t found = set.find(c);
        if (found != std::string_view::npos) components.push_back(static_cast<int>(found));
      }
      if (components.size() == letters.size() && !letters.empty() && letters.size() <= 4) {
        ++at_;
        return components;
      }
    }
    refuse(fmt::format("'.{}' is not understood", printable(letters)));
    return {};
  }

  Value chosen(const Value& from, const std::vector<int>& components) {
    if (from.is_projected) return refuse("takes the projection apart");
    Value value;
    value.count = static_cast<int>(components.size());
    value.is_rounded = from.is_rounded;
    for (std::size_t i = 0; i < components.size(); ++i) {
      const int component = components[i];
      if (component >= from.count) return refuse("has no such component");
      value.numbers.at(i) = from.numbers.at(static_cast<std::size_t>(component));
      value.defined |= (from.defined >> static_cast<unsigned>(component) & 1U) << i;
    }
    return checked(value);
  }

  Value checked(const Value& value) {
    const unsigned all = (1U << static_cast<unsigned>(value.count)) - 1;
    return (value.defined & all) == all ? value : refuse("was not assigned before");
  }

  Value combined(std::string_view by, const Value& a, const Value& b) {
    if (refusal_) return {};
    if (a.is_projected || b.is_projected) return refuse("computes with projected positions");
    if (a.is_integer && b.is_integer && by == "/") return refuse("divides integers");
    if (a.count != b.count && a.count != 1 && b.count != 1) return refuse("mixes sizes of vectors");
    Value value;
    value.count = std::max(a.count, b.count);
    value.is_integer = a.is_integer && b.is_integer;
    value.is_rounded = a.is_rounded || b.is_rounded;
    for (std::size_t i = 0; i < static_cast<std::size_t>(value.count); ++i) {
      const Rounded one =
          operate(by, a.numbers.at(a.count == 1 ? 0 : i), b.numbers.at(b.count == 1 ? 0 : i));
      value.numbers.at(i) = one.number;
      value.is_rounded = value.is_rounded || one.is_rounded;
    }
    value.defined = (1U << static_cast<unsigned>(value.count)) - 1;
    return value;
  }

  Value expression(int depth) {
    Value value = product(depth);
    while (!refusal_ && (word() == "+" || word() == "-")) {
      const std::string_view by = word();
      ++at_;
      value = combined(by, value, product(depth));
    }
    return value;
  }

  Value product(int depth) {
    Value value = factor(depth);
    while (!refusal_ && (word() == "*" || word() == "/")) {
      const std::string_view by = word();
      ++at_;
      value = combined(by, value, factor(depth));
    }
    return value;
  }

  Value factor(int depth) {
    if (depth > kMaxDepth) return refuse("is nested too deeply");
    const bool is_matrix = is_among(
        word(), {"gl_ModelViewProjectionMatrix", "gl_ProjectionMatrix", "gl_ModelViewMatrix"});
    if (!is_matrix || word(1) != "*") return unary(depth);
    // The model-view matrix is the identity: shader_runner has no command for it.
    const bool projects = word() != "gl_ModelViewMatrix" && has_projection_;
    at_ += 2;
    Value value = factor(depth + 1);
    if (refusal_) return {};
    if (value.count != 4) return refuse("multiplies a matrix by no vec4");
    if (projects && value.is_projected) return refuse("projects twice");
    value.is_projected = value.is_projected || projects;
    return value;
  }

  Value unary(int depth) {
    bool is_negative = false;
    while (word() == "-" || word() == "+") {
      is_negative = (word() == "-") != is_negative;
      ++at_;
    }
    Value value = primary(depth);
    while (!refusal_ && take(".")) {
      const std::vector<int> components = swizzle();
      if (!refusal_) value = chosen(value, components);
    }
    if (refusal_) return {};
    if (is_negative && value.is_projected) return refuse("negates the projection");
    for (float& number : value.numbers) number = is_negative ? -number : number;
    return checked(value);
  }

  Value primary(int depth) {
    if (refusal_) return {};
    if (take("(")) {
      const Value value = expression(depth + 1);
      if (!refusal_ && !take(")")) refuse("has no ')'");
      return value;
    }
    if (!is_name(word())) return number();
    const std::string root(word());
    if (word(1) == "(") return call(root, depth);
    std::string name = root;
    ++at_;
    if (is_array(root)) {
      name += index();
      if (name == root) return refuse(fmt::format("'{}' is an array", printable(root)));
    }
    Value value = read(name, root);
    // An index is a component of a vector.
    if (refusal_ || word() != "[") return value;
    const std::optional<int> component = integer(word(1));
    if (!component || *component < 0 || index().empty()) return refuse("has no constant index");
    return chosen(value, {*component});
  }

  Value number() {
    const std::optional<float> read = literal(word());
    if (!read) return refuse(fmt::format("'{}' is not understood", printable(word())));
    Value value;
    value.numbers[0] = *read;
    value.defined = 1;
    value.is_integer = integer(word()).has_value();
    ++at_;
    return value;
  }

  Value call(const std::string& name, int depth) {
    const int count = components_of(name);
    if (name == "ftransform" && word(2) == ")") {
      at_ += 3;
      Value value = read("gl_Vertex", "gl_Vertex");
      value.is_projected = has_projection_;
      return value;
    }
    if (count == 0) return refuse(fmt::format("calls {}()", printable(name)));
    at_ += 2;
    Value value;
    value.count = count;
    std::size_t filled = 0;
    std::size_t arguments = 0;
    do {
      const Value part = expression(depth + 1);
      if (refusal_) return {};
      if (part.is_projected) return refuse("takes the projection apart");
      value.is_rounded = value.is_rounded || part.is_rounded;
      for (int i = 0; i < part.count && filled < 4; ++i) {
        value.numbers.at(filled++) = part.numbers.at(static_cast<std::size_t>(i));
      }
      ++arguments;
    } while (take(","));
    if (!take(")")) return refuse("has no ')'");
    if (arguments == 1 && filled == 1) value.numbers.fill(value.numbers[0]);
    if (filled < static_cast<std::size_t>(count) && (arguments > 1 || filled != 1)) {
      return refuse(fmt::format("has too few numbers for a {}", name));
    }
    value.defined = (1U << static_cast<unsigned>(count)) - 1;
    return value;
  }

  Value read(const std::string& name, const std::string& root) {
    if (is_input(root)) return input(root);
    const auto doubted = run_->refused_.find(root);
    if (doubted != run_->refused_.end()) return refuse(doubted->second);
    const auto known = run_->values_.find(name);
    if (known != run_->values_.end()) return known->second;
    const Global* global = shader_->find(root);
    if (global != nullptr && !global->storage.empty()) {
      return refuse(fmt::format("reads '{}', which is declared as {} {}", printable(root),
                                global->storage, printable(global->type)));
    }
    return refuse(fmt::format("reads '{}', which is not known here", printable(root)));
  }

  Value input(const std::string& name) {
    const Global* global = shader_->find(name);
    Value value;
    value.count = global == nullptr ? 4 : components_of(global->type);
    if (value.count == 0 || (global != nullptr && global->is_array)) {
      return refuse(
          fmt::format("reads '{}', which is no float or vector of floats", printable(name)));
    }
    auto found = inputs_->find(name);
    if (found == inputs_->end() && global != nullptr && global->slot) {
      found = inputs_->find(std::to_string(*global->slot));
    }
    if (found == inputs_->end()) {
      return refuse(fmt::format("reads '{}', which has no numbers of type float in what is drawn",
                                printable(name)));
    }
    value.numbers = found->second;
    value.defined = (1U << static_cast<unsigned>(value.count)) - 1;
    return value;
  }

  const Shader* shader_;
  const Inputs* inputs_;
  bool has_projection_;
  VertexRun* run_;
  Tokens tokens_;
  std::size_t at_ = 0;
  std::size_t statement_ = 0;  ///< where the statement begins
  std::optional<Refusal> refusal_;
  std::optional<Refusal> may_have_returned_;
  bool has_returned_ = false;
};

VertexRun::VertexRun(const Shader& shader, const Inputs& inputs, bool has_projection) {
  Interpreter(shader, inputs, has_projection, *this).execute(shader.main);
}

bool VertexRun::is_assigned(const std::string& name) const {
  return values_.contains(name) || refused_.contains(name.substr(0, name.find('[')));
}

Expected<Value> VertexRun::value(const std::string& name) const {
  const auto refused = refused_.find(name.substr(0, name.find('[')));
  if (refused != refused_.end()) return tl::unexpected(refused->second);
  const auto known = values_.find(name);
  if (known == values_.end()) return tl::unexpected(Refusal{0, "is never assigned"});
  return known->second;
}

}  // namespace rastercheck::cases::shader_test_importer
