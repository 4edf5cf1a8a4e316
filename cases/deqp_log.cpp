#include "cases/deqp_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

#include "cases/base64.h"
#include "cases/internal/markup.h"
#include "cases/json.h"

namespace rastercheck::cases {
namespace {

/// The number of digits that dEQP prints: the default precision of a C++ stream.
constexpr std::size_t kDigits = 6;

constexpr std::string_view kBegin = "#beginTestCaseResult ";
constexpr std::string_view kEnd = "#endTestCaseResult";
constexpr std::string_view kTerminate = "#terminateTestCaseResult";

bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

/// Returns the number if the text is the prefix and a number, as in "Sample count = 4".
std::optional<int> integer_after(std::string_view text, std::string_view prefix) {
  if (!take(text, prefix)) return std::nullopt;
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Removes the line ends and the indentation that dEQP writes into the bytes of an image.
std::string without_spaces(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; });
  return text;
}

std::size_t significant_digits(std::string_view number) {
  std::size_t count = 0;
  for (const char c : number) {
    if (c == 'e') break;
    if ((c >= '1' && c <= '9') || (c == '0' && count > 0)) ++count;
  }
  return count;
}

/// Removes a number from the front of a text. For now, its uncertainty is only a flag: 1 if the
/// number has all kDigits digits, else 0. mark_rounded() replaces it by the real uncertainty.
std::optional<DeqpNumber> take_number(std::string_view& text) {
  double printed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), printed);
  if (error != std::errc() || !(std::fabs(printed) <= 0x1p64)) return std::nullopt;
  const auto length = static_cast<std::size_t>(end - text.data());
  const bool has_all = significant_digits(text.substr(0, length)) >= kDigits;
  text.remove_prefix(length);
  return DeqpNumber{static_cast<float>(printed), has_all ? 1.0 : 0.0};
}

/// Removes "(1, 2, 3, 4)" from the front of a text.
std::optional<std::array<DeqpNumber, 4>> take_vector(std::string_view& text) {
  std::array<DeqpNumber, 4> numbers;
  if (!take(text, "(")) return std::nullopt;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i > 0 && !take(text, ", ")) return std::nullopt;
    const std::optional<DeqpNumber> number = take_number(text);
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  if (!take(text, ")")) return std::nullopt;
  return numbers;
}

/// If one number in a column has six digits, shorter ones only lost zeros at their ends. All may
/// then be off by half a unit of the sixth digit, plus our rounding to float32. If all are shorter,
/// they were literals in the test's source, so the nearest float32 is the number that was drawn.
void mark_rounded(std::vector<DeqpVertex>& vertices, std::size_t column, bool is_color) {
  const auto number_of = [&](DeqpVertex& vertex) -> DeqpNumber& {
    return is_color ? (*vertex.color)[column] : vertex.position[column];
  };
  const bool is_rounded = std::any_of(vertices.begin(), vertices.end(), [&](DeqpVertex& vertex) {
    return number_of(vertex).uncertainty > 0;
  });
  for (DeqpVertex& vertex : vertices) {
    DeqpNumber& number = number_of(vertex);
    number.uncertainty = 0;
    const double magnitude = std::fabs(double{number.value});
    if (!is_rounded || magnitude == 0) continue;
    const double first = std::pow(10.0, std::floor(std::log10(magnitude)));
    number.uncertainty = first * 0.5e-5 + magnitude * 0x1p-24;
  }
}

/// Fills in a test, element by element.
class TestReader {
 public:
  TestReader(DeqpTest& test, const std::string& file) : test_(test), file_(file) {}

  /// Reads the document of a test. If `may_break_off`, the document may end before its verdict.
  Result<void> read(std::string_view document, bool may_break_off);

 private:
  std::optional<std::string> begin(const MarkupEvent& event);
  std::optional<std::string> end(const MarkupEvent& event);
  void message(std::string_view text);
  bool begins_drawing(std::string_view text);
  bool is_of_something_else(std::string_view text);
  void add_vertices(std::string_view text);
  std::optional<std::string> finish_image();
  void finish_drawing();
  void refuse(std::string reason) {
    if (test_.reason.empty()) test_.reason = std::move(reason);
  }

  DeqpTest& test_;
  const std::string& file_;
  std::vector<std::string> open_;      ///< names of the open elements
  std::vector<std::string> sections_;  ///< descriptions of the open sections
  std::string text_;                   ///< text of the innermost element so far
  std::optional<DeqpDrawing> drawing_;
  bool is_result_image_ = false;
  DeqpImage image_;
};

Result<void> TestReader::read(std::string_view document, bool may_break_off) {
  MarkupReader reader(document);
  const auto fail = [&](std::string_view reason) -> Result<void> {
    return tl::unexpected(Error{file_, printable(test_.path), std::string(reason)});
  };
  while (true) {
    const std::optional<MarkupEvent> event = reader.next();
    if (!event) {
      if (may_break_off) break;
      return fail(
          "not XML as dEQP writes it: " +
          printable(reader.rest().substr(0, std::min<std::size_t>(40, reader.rest().size()))));
    }
    if (event->kind == MarkupEvent::Kind::none) break;
    std::optional<std::string> fault;
    if (event->kind == MarkupEvent::Kind::begin) fault = begin(*event);
    if (event->kind == MarkupEvent::Kind::text) text_ += event->text;
    if (event->kind == MarkupEvent::Kind::end) fault = end(*event);
    if (fault) return fail(*fault);
  }
  if (!open_.empty() && !may_break_off) return fail("ends within " + open_.back());
  finish_drawing();
  if (test_.drawings.empty()) refuse("the log shows no drawing of triangles");
  return {};
}

std::optional<std::string> TestReader::begin(const MarkupEvent& event) {
  constexpr std::size_t kDeepest = 32;
  if (open_.size() == kDeepest) return "elements nest too deep";
  open_.push_back(event.name);
  text_.clear();
  if (event.name == "Section") sections_.emplace_back(event.attribute("Description"));
  if (event.name == "Result") test_.status = event.attribute("StatusCode");
  if (event.name == "Image") {
    is_result_image_ = drawing_ && event.attribute("Name") == "Result";
    const std::string_view format = event.attribute("Format");
    image_ = {};
    image_.width = integer_after(event.attribute("Width"), "").value_or(0);
    image_.height = integer_after(event.attribute("Height"), "").value_or(0);
    image_.channels = format == "RGBA8888" ? 4 : format == "RGB888" ? 3 : 0;
    image_.is_png = event.attribute("CompressionMode") == "PNG";
  }
  return std::nullopt;
}

std::optional<std::string> TestReader::end(const MarkupEvent& event) {
  if (open_.empty() || open_.back() != event.name) {
    return "</" + printable(event.name) + "> ends nothing";
  }
  open_.pop_back();
  const std::string text = std::exchange(text_, {});
  if (event.name == "Text") message(text);
  if (event.name == "Image" && is_result_image_) {
    Result<std::string> bytes = from_base64(without_spaces(text));
    if (!bytes) return "the image Result is not base64";
    image_.bytes = std::move(*bytes);
    return finish_image();
  }
  if (event.name == "Section" && !sections_.empty()) {
    finish_drawing();
    sections_.pop_back();
  }
  return std::nullopt;
}

void TestReader::message(std::string_view text) {
  if (const auto samples = integer_after(text, "Sample count = "); samples && *samples > 1) {
    refuse(fmt::format("{} samples per pixel, whose positions the log does not have", *samples));
  }
  if (const auto bits = integer_after(text, "SUBPIXEL_BITS = "); bits) {
    test_.subpixel_bits = std::clamp(*bits, 0, kMaxSubpixelBits);
  }
  std::string_view format = text;
  if (take(format, "Verifying rasterization result. Native format is RGB") && format != "888") {
    refuse("its picture has other than 8 bits per channel");
  }
  if (is_of_something_else(text) || begins_drawing(text)) return;
  if (drawing_ && (text.starts_with("Triangle ") || text.starts_with("\t("))) add_vertices(text);
}

/// If a message shows that the test's drawing cannot be judged, keeps the reason and returns true.
bool TestReader::is_of_something_else(std::string_view text) {
  const auto has = [&](std::string_view part) { return text.find(part) != std::string_view::npos; };
  if (text.starts_with("Drawing gray triangles") || text.starts_with("Drawing test pattern")) {
    refuse("the log does not have the positions of its vertices");
    return true;
  }
  if (!text.starts_with("Rendering ")) return false;
  if (!has(" line") && !has(" point")) return false;
  refuse("draws lines or points");
  return true;
}

bool TestReader::begins_drawing(std::string_view text) {
  const std::string_view name =
      std::string_view(test_.path).substr(std::min(test_.path.rfind('.') + 1, test_.path.size()));
  std::optional<Topology> topology;
  if (text.starts_with("Rendering triangle strip")) topology = Topology::strip;
  if (text.starts_with("Rendering triangle fan")) topology = Topology::fan;
  if (text.starts_with("Rendering ") && text.ends_with(" triangle(s):")) {
    topology = Topology::triangles;
  }
  if (text == "Generated vertices:") {
    // These messages do not say how vertices form primitives; the test's name does.
    if (name.starts_with("triangle_strip")) topology = Topology::strip;
    if (name.starts_with("triangle_fan")) topology = Topology::fan;
    if (name.starts_with("triangles")) topology = Topology::triangles;
    if (!topology) refuse("draws lines or points");
  }
  if (!topology) return false;
  finish_drawing();
  drawing_ = DeqpDrawing();
  drawing_->topology = *topology;
  if (!sections_.empty()) drawing_->section = sections_.back();
  return true;
}

void TestReader::add_vertices(std::string_view text) {
  while (true) {
    text.remove_prefix(std::min(text.find('('), text.size()));
    if (text.empty()) return;
    DeqpVertex vertex;
    const auto position = take_vector(text);
    if (!position) return refuse("the log has vertices that cannot be read");
    vertex.position = *position;
    if (take(text, ",\tcolor= ")) {
      vertex.color = take_vector(text);
      if (!vertex.color) return refuse("the log has colours that cannot be read");
    }
    drawing_->vertices.push_back(vertex);
  }
}

std::optional<std::string> TestReader::finish_image() {
  const bool has_size = image_.width > 0 && image_.height > 0 && image_.width <= kMaxSize &&
                        image_.height <= kMaxSize && image_.channels > 0;
  if (!has_size) return "the image Result has no size or format that dEQP writes";
  drawing_->image = std::move(image_);
  finish_drawing();
  return std::nullopt;
}

void TestReader::finish_drawing() {
  if (!drawing_) return;
  DeqpDrawing drawing = *std::exchange(drawing_, std::nullopt);
  std::vector<DeqpVertex>& vertices = drawing.vertices;
  const bool has_colors = !vertices.empty() && vertices.front().color.has_value();
  const bool is_list = drawing.topology == Topology::triangles;
  if (vertices.size() < 3 || (is_list && vertices.size() % 3 != 0)) {
    return refuse("the log lacks vertices");
  }
  for (const DeqpVertex& vertex : vertices) {
    if (vertex.color.has_value() != has_colors) return refuse("only some vertices have colours");
  }
  if (drawing.image.bytes.empty()) {
    return refuse("the log lacks the picture (dEQP: --deqp-log-images=enable)");
  }
  for (std::size_t column = 0; column < 4; ++column) {
    mark_rounded(vertices, column, false);
    if (!has_colors) continue;
    mark_rounded(vertices, column, true);
    for (const DeqpVertex& vertex : vertices) {
      if ((*vertex.color)[column].uncertainty > 0) refuse("the log has colours of six digits only");
    }
  }
  test_.drawings.push_back(std::move(drawing));
}

/// Removes the first line of a text, and returns the line without its line end.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// Returns the start of the first line that ends a test, or the text's size if no line does. Looks
/// at each line once, because logs have tens of thousands of tests.
std::size_t end_of_document(std::string_view text) {
  std::size_t line = 0;
  while (true) {
    const std::string_view rest = text.substr(line);
    for (const std::string_view mark : {kBegin, kEnd, kTerminate}) {
      if (rest.starts_with(mark)) return line;
    }
    const std::size_t next = text.find("\n#", line);
    if (next == std::string_view::npos) return text.size();
    line = next + 1;
  }
}

}  // namespace

Result<std::vector<DeqpTest>> parse_deqp_log(std::string_view text, const std::string& file) {
  std::vector<DeqpTest> tests;
  while (!text.empty()) {
    std::string_view line = take_line(text);
    if (!take(line, kBegin)) continue;
    DeqpTest& test = tests.emplace_back();
    test.path = line;
    if (test.path.find("multisample") != std::string::npos) {
      test.reason = "several samples per pixel, whose positions the log does not have";
    }
    const std::size_t length = end_of_document(text);
    const std::string_view document = text.substr(0, length);
    text.remove_prefix(length);
    const bool is_whole = text.starts_with(kEnd);
    if (const auto read = TestReader(test, file).read(document, !is_whole); !read) {
      return tl::unexpected(read.error());
    }
    std::string_view last = text.substr(0, text.find('\n'));
    if (take(last, kTerminate)) {
      take(last, " ");
      test.status = last;
    }
  }
  if (tests.empty()) {
    return tl::unexpected(Error{file, "", "not a log of dEQP: no line #beginTestCaseResult"});
  }
  return tests;
}

}  // namespace rastercheck::cases
