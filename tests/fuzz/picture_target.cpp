// Picture files as `rastercheck judge` reads them, and the answers of the process that reads them
// for it. OpenEXR files are left out: a broken file may crash their library, which therefore runs
// only in a separate process.

#include "cases/picture_process.h"
#include "cases/picture_reader.h"
#include "tests/fuzz/target.h"

namespace {

using namespace rastercheck;
using fuzz::expect;

void check_picture(const Result<cases::PictureFile>& picture) {
  if (!picture) {
    fuzz::expect_one_line(picture.error());
    return;
  }
  expect(picture->values.size() == picture->value_count(), "a picture has all its numbers");
  expect(picture->stored.size() == picture->channels.size(), "each channel is stored somehow");
  const std::string reply = cases::picture_to_reply(picture);
  const Result<cases::PictureFile> again = cases::picture_from_reply(reply, "again");
  expect(again.has_value(), "a picture that was sent can be read");
  expect(cases::picture_to_reply(again) == reply, "a picture that was sent is read as the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto text = fuzz::text_of(data, size);
  if (!text.starts_with("\x76\x2f\x31\x01")) {
    check_picture(cases::parse_picture(text, "input", cases::ArrayOrder::hwc));
    check_picture(cases::parse_picture(text, "input", cases::ArrayOrder::chw));
  }
  check_picture(cases::picture_from_reply(text, "input"));
  return 0;
}
