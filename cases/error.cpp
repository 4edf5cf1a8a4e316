#include "cases/error.h"

#include "cases/json.h"

namespace rastercheck {

std::string to_string(const Error& error) {
  std::string line;
  // A file's name is the only part that nobody has looked at yet.
  for (const std::string& part : {cases::printable(error.file), error.place, error.reason}) {
    if (part.empty()) continue;
    if (!line.empty()) line += ": ";
    line += part;
  }
  return line;
}

}  // namespace rastercheck
