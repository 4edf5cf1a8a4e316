#pragma once

// Reads the XML that dEQP writes into its logs: elements, attributes, text and the five named
// entities. Does not read comments, CDATA, document types, or processing instructions after the
// first; dEQP writes none of these.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rastercheck::cases {

/// The beginning of an element, with its attributes; the end of an element; or text between tags.
struct MarkupEvent {
  enum class Kind { begin, end, text, none };
  Kind kind = Kind::none;  ///< `none`: the document has ended
  std::string name;        ///< the element's name
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;

  /// The value of the attribute with this name; empty if the element has none.
  std::string_view attribute(std::string_view wanted) const;
};

/// Reads a document once, from front to back. The caller must check that elements nest properly.
class MarkupReader {
 public:
  explicit MarkupReader(std::string_view document) : rest_(document) {}

  /// Returns the next event; empty if the text is malformed. An element without content, `<a />`,
  /// gives two events: its beginning and its end.
  std::optional<MarkupEvent> next();
  /// The part of the document that was not read.
  std::string_view rest() const { return rest_; }

 private:
  std::optional<MarkupEvent> next_tag();

  std::string_view rest_;
  std::string ends_;  ///< name of an element like <a />, whose end comes next
};

}  // namespace rastercheck::cases
