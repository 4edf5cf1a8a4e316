// PNG pictures by libpng's row interface. Its simplified interface converts numbers to sRGB where a
// file names another transfer function; here the stored numbers count.

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "cases/internal/picture_encoders.h"
#include "cases/internal/picture_formats.h"

namespace rastercheck::cases {
namespace {

struct PngSource {
  std::string_view bytes;
  std::string reason;
};

void read_bytes(png_structp png, png_bytep to, std::size_t count) {
  auto* const source = static_cast<PngSource*>(png_get_io_ptr(png));
  if (source->bytes.size() < count) png_error(png, "the file ends too early");
  std::memcpy(to, source->bytes.data(), count);
  source->bytes.remove_prefix(count);
}

[[noreturn]] void take_error(png_structp png, png_const_charp reason) {
  static_cast<PngSource*>(png_get_error_ptr(png))->reason = reason;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp /*png*/, png_const_charp /*reason*/) {}

/// Shared by libpng and the decoder; outlives every jump out of libpng.
struct PngDecoder {
  png_structp png = nullptr;
  png_infop info = nullptr;
  PngSource source;
  PictureFile picture;
  std::vector<png_byte> rows;  ///< all of them, as interlaced pictures need
  std::vector<png_bytep> row_starts;
  std::size_t channels = 0;
  bool is_16_bit = false;

  PngDecoder() = default;
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;
  ~PngDecoder() { png_destroy_read_struct(&png, &info, nullptr); }
};

/// Reads the header. Returns false, with a reason, for a picture that is not read.
bool read_png_header(PngDecoder& d) {
  png_read_info(d.png, d.info);
  const png_byte color = png_get_color_type(d.png, d.info);
  const png_byte depth = png_get_bit_depth(d.png, d.info);
  d.channels = png_get_channels(d.png, d.info);
  const png_uint_32 width = png_get_image_width(d.png, d.info);
  const png_uint_32 height = png_get_image_height(d.png, d.info);
  if (color == PNG_COLOR_TYPE_PALETTE) {
    d.source.reason = "has a palette; only grey and colour PNG are read";
    return false;
  }
  if (depth < 8) {
    d.source.reason = "has less than 8 bits per channel; 8 and 16 are read";
    return false;
  }
  if (const auto fault = size_fault(width, height, d.channels)) {
    d.source.reason = *fault;
    return false;
  }
  d.is_16_bit = depth == 16;
  d.picture.width = static_cast<int>(width);
  d.picture.height = static_cast<int>(height);
  if (d.is_16_bit) png_set_swap(d.png);  // to the machine's little-endian order
  png_set_interlace_handling(d.png);
  png_read_update_info(d.png, d.info);
  const std::size_t row_bytes = png_get_rowbytes(d.png, d.info);
  d.rows.resize(row_bytes * height);
  d.row_starts.resize(height);
  for (std::size_t y = 0; y < height; ++y) d.row_starts[y] = d.rows.data() + y * row_bytes;
  return true;
}

/// Runs libpng. Only trivially destructible locals: a jump may leave this frame.
bool decode(PngDecoder& d) {
  d.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &d.source, &take_error, &ignore_warning);
  if (d.png == nullptr) return false;
  d.info = png_create_info_struct(d.png);
  if (d.info == nullptr) return false;
  // NOLINTNEXTLINE(cert-err52-cpp): libpng has no other way to report an error.
  if (setjmp(png_jmpbuf(d.png)) != 0) return false;
  png_set_read_fn(d.png, &d.source, &read_bytes);
  if (!read_png_header(d)) return false;
  png_read_image(d.png, d.row_starts.data());
  png_read_end(d.png, nullptr);
  return true;
}

std::vector<std::string> png_channel_names(std::size_t count) {
  return count == 2 ? std::vector<std::string>{"Y", "A"} : default_channel_names(count);
}

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }

PictureOrReason read_png(std::string_view bytes) {
  PngDecoder d;
  d.source.bytes = bytes;
  if (!decode(d)) {
    const std::string reason = d.source.reason.empty() ? "libpng cannot start" : d.source.reason;
    return tl::unexpected("PNG: " + reason);
  }
  PictureFile picture = std::move(d.picture);
  picture.channels = png_channel_names(d.channels);
  picture.stored.assign(d.channels, d.is_16_bit ? Storage::unorm16 : Storage::unorm8);
  picture.values.resize(picture.value_count());
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    if (d.is_16_bit) {
      std::uint16_t code = 0;
      std::memcpy(&code, d.rows.data() + 2 * i, sizeof code);
      picture.values[i] = code;
    } else {
      picture.values[i] = d.rows[i];
    }
  }
  return picture;
}

namespace {

/// Shared by libpng and the encoder; outlives every jump out of libpng.
struct PngEncoder {
  png_structp png = nullptr;
  png_infop info = nullptr;
  PngSource errors;
  std::string bytes;

  PngEncoder() = default;
  PngEncoder(const PngEncoder&) = delete;
  PngEncoder& operator=(const PngEncoder&) = delete;
  ~PngEncoder() { png_destroy_write_struct(&png, &info); }
};

void append_bytes(png_structp png, png_bytep from, std::size_t count) {
  auto* const encoder = static_cast<PngEncoder*>(png_get_io_ptr(png));
  encoder->bytes.append(reinterpret_cast<const char*>(from), count);
}

void flush_nothing(png_structp /*png*/) {}

/// The picture as libpng takes it.
struct PngImage {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  int depth = 8;
  int color = PNG_COLOR_TYPE_RGB;
  std::vector<png_byte> rows;
  std::vector<png_bytep> row_starts;
  std::vector<png_text> texts;
};

/// Runs libpng. Only trivially destructible locals: a jump may leave this frame.
bool encode(PngEncoder& e, PngImage& image) {
  e.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &e.errors, &take_error, &ignore_warning);
  if (e.png == nullptr) return false;
  e.info = png_create_info_struct(e.png);
  if (e.info == nullptr) return false;
  // NOLINTNEXTLINE(cert-err52-cpp): libpng has no other way to report an error.
  if (setjmp(png_jmpbuf(e.png)) != 0) return false;
  png_set_write_fn(e.png, &e, &append_bytes, &flush_nothing);
  png_set_IHDR(e.png, e.info, image.width, image.height, image.depth, image.color,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_text(e.png, e.info, image.texts.data(), static_cast<int>(image.texts.size()));
  png_write_info(e.png, e.info);
  if (image.depth == 16) png_set_swap(e.png);
  png_write_image(e.png, image.row_starts.data());
  png_write_end(e.png, nullptr);
  return true;
}

/// libpng's colour type for a picture's channels; empty if PNG has none.
std::optional<int> png_color_of(const std::vector<std::string>& channels) {
  using Names = std::vector<std::string>;
  if (channels == Names{"Y"}) return PNG_COLOR_TYPE_GRAY;
  if (channels == Names{"Y", "A"}) return PNG_COLOR_TYPE_GRAY_ALPHA;
  if (channels == Names{"R", "G", "B"}) return PNG_COLOR_TYPE_RGB;
  if (channels == Names{"R", "G", "B", "A"}) return PNG_COLOR_TYPE_RGB_ALPHA;
  return std::nullopt;
}

}  // namespace

BytesOrReason write_png(const PictureFile& picture, const PictureTexts& texts) {
  const auto refuse = [](const char* reason) { return tl::unexpected(std::string(reason)); };
  const Storage storage = picture.stored.front();
  const bool is_uniform = std::all_of(picture.stored.begin(), picture.stored.end(),
                                      [storage](Storage one) { return one == storage; });
  if (!is_uniform || (storage != Storage::unorm8 && storage != Storage::unorm16)) {
    return refuse("PNG holds unorm8 or unorm16 numbers");
  }
  const std::optional<int> color = png_color_of(picture.channels);
  if (!color) return refuse("PNG has the channels Y; Y, A; R, G, B; or R, G, B, A");
  PngImage image;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.color = *color;
  const std::size_t size = storage == Storage::unorm16 ? 2 : 1;
  image.depth = static_cast<int>(8 * size);
  image.rows.resize(picture.values.size() * size);
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    const auto code = static_cast<std::uint16_t>(picture.values[i]);
    std::memcpy(image.rows.data() + i * size, &code, size);
  }
  const std::size_t row_bytes = image.rows.size() / image.height;
  for (std::size_t y = 0; y < image.height; ++y) {
    image.row_starts.push_back(image.rows.data() + y * row_bytes);
  }
  PictureTexts kept = texts;  // a copy, since libpng takes non-const char*
  for (auto& [key, text] : kept) {
    png_text one{};
    one.compression = PNG_TEXT_COMPRESSION_NONE;
    one.key = key.data();
    one.text = text.data();
    one.text_length = text.size();
    image.texts.push_back(one);
  }
  PngEncoder encoder;
  if (!encode(encoder, image)) return tl::unexpected("PNG: " + encoder.errors.reason);
  return std::move(encoder.bytes);
}

}  // namespace rastercheck::cases
