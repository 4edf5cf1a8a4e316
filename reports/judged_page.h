#pragma once

// A judged picture as a self-contained page: shows whether the picture is right, which pixels are
// wrong, and each pixel of the parts that are worth a look.

#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/error.h"
#include "cases/picture_file.h"
#include "cases/picture_view.h"
#include "records/judged_picture.h"
#include "records/picture_part.h"

namespace rastercheck::reports {

struct JudgedPage {
  cases::Case source;
  cases::PictureView view;
  cases::PictureFile picture;
  cases::Contract contract;
  records::JudgedPicture judged;
  std::vector<records::PicturePart> parts;
  std::string case_file;     ///< "-" for standard input
  std::string picture_file;  ///< "-" for standard input
  /// Who makes the promise: "what the case asks for", "what gl:llvmpipe promises".
  std::string judged_by;
  std::vector<std::string> command;  ///< judges the picture again: the program and its arguments
  /// Explains the case, without --pixel; empty if the case cannot be read a second time.
  std::vector<std::string> explain;
};

/// True if row 0 of the file is the lowest one as displayed.
bool is_upwards(const JudgedPage& page);

/// Names the part of the case that a channel shows, for people: "x", "depth", "the number 0.5".
std::string shown_text(const JudgedPage& page, std::size_t channel);

/// Returns the page as HTML. Fails if one of its pictures cannot be encoded.
Result<std::string> judged_html(const JudgedPage& page);

}  // namespace rastercheck::reports
