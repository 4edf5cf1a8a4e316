// Pictures come back from every format as they were written, and broken files are refused in one
// line.

#include "cases/picture_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "cases/picture_process.h"
#include "cases/picture_writer.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cases::picture_reader_test {
namespace {

using ::testing::HasSubstr;

/// 3 × 2 pixels with numbers that a format may spoil: subnormal, negative zero, infinite, NaN.
PictureFile floats(std::vector<std::string> channels) {
  PictureFile picture;
  picture.width = 3;
  picture.height = 2;
  picture.channels = std::move(channels);
  picture.stored.assign(picture.channels.size(), Storage::float32);
  const std::vector<float> values{
      0.1F, -0.0F, 1e-45F, std::numeric_limits<float>::infinity(), std::nanf("7"), -3e38F, 0.5F};
  for (std::size_t i = 0; i < picture.value_count(); ++i) {
    picture.values.push_back(values[i % values.size()] * (i < values.size() ? 1.0F : 0.75F));
  }
  return picture;
}

/// Codes from 0 to the greatest.
PictureFile codes(std::vector<std::string> channels, Storage storage) {
  PictureFile picture = floats(std::move(channels));
  picture.stored.assign(picture.channels.size(), storage);
  const int greatest = storage == Storage::unorm16 ? 65535 : 255;
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    picture.values[i] = static_cast<float>(static_cast<int>(i) * 7919 % (greatest + 1));
  }
  picture.values.back() = static_cast<float>(greatest);
  return picture;
}

/// NaN by its bits.
std::vector<std::uint32_t> bits_of(const std::vector<float>& values) {
  std::vector<std::uint32_t> bits(values.size());
  std::memcpy(bits.data(), values.data(), values.size() * sizeof(float));
  return bits;
}

PictureFile read_back(const PictureFile& picture, const std::string& name) {
  const TemporaryFolder folder;
  const Result<void> written = write_picture(picture, folder.path(name));
  EXPECT_TRUE(written.has_value()) << to_string(written.error());
  const Result<PictureFile> read = read_picture(folder.path(name), ArrayOrder::hwc);
  EXPECT_TRUE(read.has_value()) << to_string(read.error());
  // The picture must also survive the reply of the process that reads pictures.
  const Result<PictureFile> sent = picture_from_reply(picture_to_reply(read), name);
  EXPECT_TRUE(sent.has_value()) << to_string(sent.error());
  return sent.value_or(PictureFile());
}

void expect_back(const PictureFile& picture, const std::string& name) {
  const PictureFile read = read_back(picture, name);
  EXPECT_EQ(read.width, picture.width) << name;
  EXPECT_EQ(read.height, picture.height) << name;
  EXPECT_EQ(read.channels, picture.channels) << name;
  EXPECT_EQ(read.stored, picture.stored) << name;
  EXPECT_EQ(bits_of(read.values), bits_of(picture.values)) << name;
}

// Kills: rows upside down, swapped channels or bytes, a transfer function on the way.
TEST(PictureReader, ReadsWhatWasWritten) {
  expect_back(floats({"A", "B", "depth", "view.id"}), "a.exr");  // in OpenEXR's order
  expect_back(floats({"Y"}), "a.pfm");
  expect_back(floats({"R", "G", "B"}), "a.pfm");
  expect_back(floats({"0", "1", "2", "3", "4"}), "a.npy");
  for (const Storage storage : {Storage::unorm8, Storage::unorm16}) {
    expect_back(codes({"Y"}, storage), "a.png");
    expect_back(codes({"Y", "A"}, storage), "a.png");
    expect_back(codes({"R", "G", "B"}, storage), "a.png");
    expect_back(codes({"R", "G", "B", "A"}, storage), "a.png");
    expect_back(codes({"R", "G"}, storage), "a.npy");
  }
}

TEST(PictureReader, ReadsHalfFloats) {
  PictureFile picture = floats({"R", "G"});
  picture.stored.assign(2, Storage::float16);
  picture.values = {0.5F, -0.0F, 0x1p-24F, 65504, -0x1.ffcp-1F, 2, 3, 4, 5, 6, 7, 8};
  expect_back(picture, "a.npy");
  picture.channels = {"G", "R"};
  expect_back(picture, "a.exr");
}

TEST(PictureReader, ReadsArraysWithTheChannelFirst) {
  const std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 1, 3)}\n";
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size());
  bytes += '\0';
  bytes += header;
  bytes += "\x01\x02\x03\x04\x05\x06";
  const Result<PictureFile> read = parse_picture(bytes, "a.npy", ArrayOrder::chw);
  ASSERT_TRUE(read.has_value()) << to_string(read.error());
  EXPECT_EQ(read->width, 3);
  EXPECT_EQ(read->height, 1);
  EXPECT_EQ(read->values, (std::vector<float>{1, 4, 2, 5, 3, 6}));
}

std::string refusal(const std::string& bytes) {
  const Result<PictureFile> read = parse_picture(bytes, "a.file", ArrayOrder::hwc);
  return read ? "read" : to_string(read.error());
}

std::string bytes_of(const PictureFile& picture, const std::string& name) {
  const TemporaryFolder folder;
  EXPECT_TRUE(write_picture(picture, folder.path(name)).has_value());
  return folder.content(name);
}

// A reader that goes beyond the end is found by the sanitizers.
TEST(PictureReader, RefusesTruncatedFilesInOneLine) {
  const std::vector<std::string> files{bytes_of(floats({"R", "G"}), "a.exr"),
                                       bytes_of(codes({"R", "G", "B"}, Storage::unorm8), "a.png"),
                                       bytes_of(floats({"R", "G"}), "a.npy"),
                                       bytes_of(floats({"Y"}), "a.pfm")};
  for (const std::string& file : files) {
    for (std::size_t length = 0; length < file.size(); ++length) {
      const std::string refused = refusal(file.substr(0, length));
      EXPECT_EQ(refused.find('\n'), std::string::npos);
      // libpng needs no more than the picture's data.
      const bool is_png_end = file.starts_with("\x89PNG") && length + 12 >= file.size();
      if (!is_png_end) {
        EXPECT_THAT(refused, HasSubstr("a.file: ")) << length;
      }
    }
  }
}

TEST(PictureReader, RefusesWhatItDoesNotRead) {
  EXPECT_THAT(refusal("GIF89a"), HasSubstr("is not a picture: expected OpenEXR, PNG, NPY or PFM"));
  EXPECT_THAT(refusal(""), HasSubstr("is not a picture"));
  EXPECT_THAT(refusal("PF\n100000 100000\n-1.0\n"),
              HasSubstr("PFM: 100000 x 100000 pixels; at most 16384 x 16384 are read"));
  EXPECT_THAT(refusal("PF\n16384 16384\n-1.0\n"), HasSubstr("numbers; at most 2^28 are read"));
  EXPECT_THAT(refusal("Pf\n0 1\n-1.0\n"), HasSubstr("has no pixels"));
  EXPECT_THAT(refusal("Pf\n1 x\n-1.0\n"), HasSubstr("its header is broken"));
  EXPECT_THAT(refusal("Pf\n1 1\n-1.0\nabc"), HasSubstr("has 3 bytes of numbers, not 4"));
  std::string array = bytes_of(floats({"R", "G"}), "a.npy");
  array.replace(array.find("False"), 5, "True ");
  EXPECT_THAT(refusal(array), HasSubstr("NPY: is in Fortran order; C order is read"));
  array = bytes_of(floats({"R", "G"}), "a.npy");
  array.replace(array.find("<f4"), 3, "<i8");
  EXPECT_THAT(refusal(array), HasSubstr("NPY: its numbers are '<i8'"));
}

// A palette of one colour: IHDR says colour type 3.
TEST(PictureReader, RefusesPalettes) {
  std::string png = bytes_of(codes({"Y"}, Storage::unorm8), "a.png");
  png[25] = 3;
  EXPECT_THAT(refusal(png), HasSubstr("PNG: "));
}

TEST(PictureWriter, RefusesWhatAFormatCannotHold) {
  const TemporaryFolder folder;
  const auto fault = [&folder](const PictureFile& picture, const std::string& name) {
    const Result<void> written = write_picture(picture, folder.path(name));
    return written ? "written" : written.error().reason;
  };
  EXPECT_EQ(fault(floats({"R", "G"}), "a.pfm"), "PFM holds 1 or 3 channels, not 2");
  EXPECT_EQ(fault(floats({"R"}), "a.png"), "PNG holds unorm8 or unorm16 numbers");
  EXPECT_EQ(fault(codes({"R"}, Storage::unorm8), "a.png"),
            "PNG has the channels Y; Y, A; R, G, B; or R, G, B, A");
  EXPECT_EQ(fault(codes({"R"}, Storage::unorm8), "a.exr"),
            "OpenEXR holds float32 and float16 numbers");
  EXPECT_THAT(fault(floats({"R"}), "a.jpg"), HasSubstr("ends in .exr, .png, .npy or .pfm"));
}

TEST(PictureReply, RefusesAnswersThatMakeNoSense) {
  const auto fault = [](const std::string& reply) {
    const Result<PictureFile> picture = picture_from_reply(reply, "a.png");
    return picture ? "read" : to_string(picture.error());
  };
  EXPECT_EQ(fault(""), "a.png: the picture reader's answer: no header line");
  const std::string header =
      R"({"width": 1, "height": 1, "channels": ["Y"], "stored": ["float32"]})";
  EXPECT_THAT(fault(header + "\nabc"), HasSubstr("its length differs from the one in its header"));
  EXPECT_THAT(fault("{}\n"), HasSubstr("missing key"));
  EXPECT_EQ(fault(picture_to_reply(tl::unexpected(Error{"b.png", "", "no\npicture"}))),
            "b.png: no\\npicture");
}

}  // namespace
}  // namespace rastercheck::cases::picture_reader_test
