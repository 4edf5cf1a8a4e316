#include "cases/base64.h"

#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/transform_width.hpp>

namespace rastercheck::cases {
namespace {

namespace iterators = boost::archive::iterators;
using Encoder =
    iterators::base64_from_binary<iterators::transform_width<std::string_view::iterator, 6, 8>>;
using Decoder =
    iterators::transform_width<iterators::binary_from_base64<std::string_view::iterator>, 8, 6>;

constexpr std::size_t kBytesOfGroup = 3;
constexpr std::size_t kDigitsOfGroup = 4;
constexpr std::string_view kAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

Error base64_refusal() { return {"", "", "must be base64, with padding and without white space"}; }

}  // namespace

std::string to_base64(std::string_view bytes) {
  // Boost's iterator always reads a whole group. So zeros fill the last group, and their digits
  // become padding.
  const std::size_t rest = bytes.size() % kBytesOfGroup;
  const std::size_t whole = bytes.size() - rest;
  const std::string_view groups = bytes.substr(0, whole);
  std::string text(Encoder(groups.begin()), Encoder(groups.end()));
  if (rest > 0) {
    std::string group(bytes.substr(whole));
    group.resize(kBytesOfGroup, '\0');
    const std::string_view last = group;
    text.append(Encoder(last.begin()), Encoder(last.end()));
    std::fill_n(text.rbegin(), kBytesOfGroup - rest, '=');
  }
  return text;
}

Result<std::string> from_base64(std::string_view text) {
  if (text.size() % kDigitsOfGroup != 0) return tl::unexpected(base64_refusal());
  const std::size_t end_of_digits = text.find_last_not_of('=') + 1;
  const std::size_t padding = text.size() - end_of_digits;
  const bool is_foreign =
      text.substr(0, end_of_digits).find_first_not_of(kAlphabet) != std::string_view::npos;
  if (padding >= kBytesOfGroup || is_foreign) return tl::unexpected(base64_refusal());

  std::string digits(text);
  std::fill_n(digits.rbegin(), padding, 'A');  // the digit 0
  const std::string_view view = digits;
  std::string bytes(Decoder(view.begin()), Decoder(view.end()));
  bytes.resize(bytes.size() - padding);
  // The last digit before the padding has bits that belong to no byte; resize() dropped them even
  // if they were not 0.
  if (padding > 0 && to_base64(bytes) != text) return tl::unexpected(base64_refusal());
  return bytes;
}

}  // namespace rastercheck::cases
