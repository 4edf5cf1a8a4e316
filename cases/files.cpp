#include "cases/files.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <system_error>

namespace rastercheck::cases {
namespace {

namespace fs = std::filesystem;

Error cannot_be_written(const fs::path& file, const std::error_code& why) {
  return {file.string(), "", "cannot be written" + (why ? ": " + why.message() : "")};
}

}  // namespace

Result<std::string> read_text(const std::string& file) {
  if (file == "-") return std::string(std::istreambuf_iterator<char>(std::cin), {});
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::stringstream content;
  // A folder opens but cannot be read; a file that is empty leaves failbit on `content`.
  if (!stream ||
      (stream.peek() != std::ifstream::traits_type::eof() && !(content << stream.rdbuf())) ||
      stream.bad()) {
    const std::error_code why(errno, std::generic_category());
    return tl::unexpected(
        Error{file, "", why ? "cannot be read: " + why.message() : "cannot be read"});
  }
  return std::move(content).str();
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
