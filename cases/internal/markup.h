#pragma once

// Reads the XML that dEQP writes into its logs: elements, attributes, text and the five named
// entities. No comments, CDATA, processing instructions but the first, or document types, which
// dEQP does not write.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rastercheck::cases {

/// An element begins (with its attributes) or ends, or text between two of these.
struct MarkupEvent {
  enum class Kind { begin, end, text, none };
  Kind kind = Kind::none;  ///< `none`: the document has ended
  std::string name;        ///< of the element
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;

  /// An attribute's value; empty if there is none of this name.
  std::string_view attribute(std::string_view wanted) const;
};

/// Goes through a document once. Does not check that elements nest: its caller does.
class MarkupReader {
 public:
  explicit MarkupReader(std::string_view document) : rest_(document) {}

  /// The next event; empty after what is no markup. An element without content, `<a />`, begins and
  /// ends at once.
  std::optional<MarkupEvent> next();
  /// The part of the document that was not read.
  std::string_view rest() const { return rest_; }

 private:
  std::optional<MarkupEvent> next_tag();

  std::string_view rest_;
  std::string ends_;  ///< the element that ended with its first tag
};

}  // namespace rastercheck::cases
