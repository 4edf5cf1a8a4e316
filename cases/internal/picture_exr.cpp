// OpenEXR pictures by the OpenEXR library.

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <vector>

#include "cases/internal/picture_encoders.h"
#include "cases/internal/picture_formats.h"

namespace rastercheck::cases {
namespace {

/// A file in memory.
class Bytes : public Imf::IStream {
 public:
  explicit Bytes(std::string_view bytes) : IStream("picture"), bytes_(bytes) {}

  bool read(char to[], int count) override {
    const auto size = static_cast<std::size_t>(std::max(count, 0));
    if (size > bytes_.size() - std::min(bytes_.size(), at_)) {
      throw std::runtime_error("the file ends too early");
    }
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t to) override { at_ = to; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// The reason why a header's picture is not read.
std::optional<std::string> header_fault(const Imf::Header& header) {
  if (header.hasType() && !Imf::isImage(header.type())) return "is deep; flat pictures are read";
  const Imath::Box2i& window = header.dataWindow();
  const Imath::Box2i& display = header.displayWindow();
  const auto side = [](int least, int greatest) {
    return static_cast<std::uint64_t>(
        std::max<std::int64_t>(0, std::int64_t{greatest} - least + 1));
  };
  std::uint64_t channels = 0;
  for (auto one = header.channels().begin(); one != header.channels().end(); ++one) ++channels;
  if (const auto fault = size_fault(side(window.min.x, window.max.x),
                                    side(window.min.y, window.max.y), channels)) {
    return fault;
  }
  if (window != display) return "its data window is not its display window";
  for (auto one = header.channels().begin(); one != header.channels().end(); ++one) {
    if (one.channel().xSampling != 1 || one.channel().ySampling != 1) {
      return fmt::format("channel {} is subsampled", one.name());
    }
  }
  return std::nullopt;
}

/// A channel's numbers, four bytes each: float32, or uint32 for channels of whole numbers.
using Plane = std::vector<std::uint32_t>;

/// Reads all pixels, a plane for each channel.
std::vector<Plane> read_planes(Imf::InputFile& file, const PictureFile& picture,
                               const std::vector<bool>& is_whole) {
  const Imath::Box2i& window = file.header().dataWindow();
  const auto width = static_cast<std::size_t>(picture.width);
  std::vector<Plane> planes(picture.channels.size(),
                            Plane(width * static_cast<std::size_t>(picture.height)));
  Imf::FrameBuffer target;
  for (std::size_t c = 0; c < planes.size(); ++c) {
    target.insert(picture.channels[c],
                  Imf::Slice::Make(is_whole[c] ? Imf::UINT : Imf::FLOAT, planes[c].data(), window,
                                   sizeof(std::uint32_t), width * sizeof(std::uint32_t)));
  }
  file.setFrameBuffer(target);
  file.readPixels(window.min.y, window.max.y);
  return planes;
}

PictureOrReason read_exr_file(std::string_view bytes) {
  Bytes stream(bytes);
  Imf::InputFile file(stream, 0);
  if (const auto fault = header_fault(file.header())) return tl::unexpected("OpenEXR: " + *fault);
  const Imath::Box2i& window = file.header().dataWindow();
  PictureFile picture;
  picture.width = window.max.x - window.min.x + 1;
  picture.height = window.max.y - window.min.y + 1;
  std::vector<bool> is_whole;
  const Imf::ChannelList& channels = file.header().channels();
  for (auto one = channels.begin(); one != channels.end(); ++one) {
    picture.channels.emplace_back(one.name());
    is_whole.push_back(one.channel().type == Imf::UINT);
    picture.stored.push_back(one.channel().type == Imf::HALF ? Storage::float16 : Storage::float32);
  }
  const std::vector<Plane> planes = read_planes(file, picture, is_whole);
  picture.values.resize(picture.value_count());
  for (std::size_t c = 0; c < planes.size(); ++c) {
    for (std::size_t i = 0; i < planes[c].size(); ++i) {
      const std::uint32_t bits = planes[c][i];
      float& value = picture.values[i * planes.size() + c];
      value = is_whole[c] ? static_cast<float>(bits) : std::bit_cast<float>(bits);
      if (is_whole[c] && double{value} != static_cast<double>(bits)) {
        return tl::unexpected(fmt::format("OpenEXR: channel {}: {} is more than float32 holds",
                                          picture.channels[c], bits));
      }
    }
  }
  return picture;
}

}  // namespace

bool is_exr(std::string_view bytes) { return bytes.starts_with("\x76\x2f\x31\x01"); }

PictureOrReason read_exr(std::string_view bytes) {
  try {
    return read_exr_file(bytes);
  } catch (const std::exception& why) {
    std::string reason = why.what();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    return tl::unexpected("OpenEXR: " + reason);
  }
}

namespace {

/// Keeps a file in memory.
class ByteSink : public Imf::OStream {
 public:
  ByteSink() : OStream("picture") {}
  void write(const char from[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (at_ + size > bytes.size()) bytes.resize(at_ + size);
    std::copy_n(from, size, bytes.data() + at_);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t to) override { at_ = to; }

  std::string bytes;

 private:
  std::size_t at_ = 0;
};

std::string exr_bytes(const PictureFile& picture, const PictureTexts& texts) {
  Imf::Header header(picture.width, picture.height);
  for (std::size_t c = 0; c < picture.channels.size(); ++c) {
    const bool is_half = picture.stored[c] == Storage::float16;
    header.channels().insert(picture.channels[c], Imf::Channel(is_half ? Imf::HALF : Imf::FLOAT));
  }
  for (const auto& [key, text] : texts) header.insert(key, Imf::StringAttribute(text));
  const std::size_t count = picture.channels.size();
  const std::size_t row_bytes = static_cast<std::size_t>(picture.width) * count * sizeof(float);
  std::vector<Imath::half> halves(picture.values.begin(), picture.values.end());
  Imf::FrameBuffer source;
  for (std::size_t c = 0; c < count; ++c) {
    const bool is_half = picture.stored[c] == Storage::float16;
    const std::size_t size = is_half ? sizeof(Imath::half) : sizeof(float);
    // OpenEXR takes a non-const char*, but does not write through it.
    const auto* first = is_half ? reinterpret_cast<const char*>(halves.data() + c)
                                : reinterpret_cast<const char*>(picture.values.data() + c);
    source.insert(picture.channels[c],
                  Imf::Slice(is_half ? Imf::HALF : Imf::FLOAT, const_cast<char*>(first),
                             count * size, row_bytes / sizeof(float) * size));
  }
  ByteSink sink;
  {
    Imf::OutputFile file(sink, header, 0);
    file.setFrameBuffer(source);
    file.writePixels(picture.height);
  }
  return std::move(sink.bytes);
}

}  // namespace

BytesOrReason write_exr(const PictureFile& picture, const PictureTexts& texts) {
  const bool is_float = std::all_of(picture.stored.begin(), picture.stored.end(), [](Storage one) {
    return one == Storage::float32 || one == Storage::float16;
  });
  if (!is_float) return tl::unexpected(std::string("OpenEXR holds float32 and float16 numbers"));
  try {
    return exr_bytes(picture, texts);
  } catch (const std::exception& why) {
    return tl::unexpected(fmt::format("OpenEXR: {}", why.what()));
  }
}

}  // namespace rastercheck::cases
