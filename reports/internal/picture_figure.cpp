#include "reports/internal/picture_figure.h"

#include <fmt/format.h>

#include <string_view>

#include "cases/base64.h"
#include "reports/internal/html.h"

namespace rastercheck::reports {

std::string picture_figure(const records::Picture& picture) {
  constexpr int kEnlarged = 320;
  // A small picture is enlarged, because its single pixels matter.
  const std::string_view style = picture.width < kEnlarged ? " class=\"small\"" : "";
  return fmt::format(
      "<figure><img{} src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">"
      "<figcaption>{}</figcaption></figure>\n",
      style, cases::to_base64(picture.png), picture.width, picture.height, html(picture.name),
      html(picture.caption));
}

}  // namespace rastercheck::reports
