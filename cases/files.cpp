#include "cases/files.h"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <istream>
#include <system_error>

namespace rastercheck::cases {
namespace {

namespace fs = std::filesystem;

Error cannot_be_written(const fs::path& file, const std::error_code& why) {
  return {file.string(), "", "cannot be written" + (why ? ": " + why.message() : "")};
}

Result<std::string> read_stream(std::istream& stream, const std::string& name, std::size_t most) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 16;
  std::string text;
  while (stream && text.size() <= most) {
    const std::size_t before = text.size();
    text.resize(before + kAtOnce);
    stream.read(text.data() + before, kAtOnce);
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (text.size() > most) {
    return tl::unexpected(Error{name, "", fmt::format("has more than {} bytes", most)});
  }
  // A folder can be opened like a file, but not read.
  if (stream.eof() && !stream.bad()) return text;
  const std::error_code why(errno, std::generic_category());
  return tl::unexpected(
      Error{name, "", why ? "cannot be read: " + why.message() : "cannot be read"});
}

}  // namespace

Result<std::string> read_text(const std::string& file, std::size_t most) {
  errno = 0;
  if (file == "-") return read_stream(std::cin, "standard input", most);
  std::ifstream stream(file, std::ios::binary);
  return read_stream(stream, file, most);
}

Result<void> write_file(const std::string& name, const std::string& content) {
  const fs::path file = name;
  fs::path partial = file;
  partial += ".partial";
  errno = 0;
  {
    std::ofstream stream(partial, std::ios::binary | std::ios::trunc);
    stream << content;
    stream.close();
    if (!stream) {
      const std::error_code why(errno, std::generic_category());
      std::error_code ignored;
      fs::remove(partial, ignored);
      return tl::unexpected(cannot_be_written(file, why));
    }
  }
  std::error_code why;
  fs::rename(partial, file, why);
  if (why) {
    std::error_code ignored;
    fs::remove(partial, ignored);
    return tl::unexpected(cannot_be_written(file, why));
  }
  return {};
}

}  // namespace rastercheck::cases
