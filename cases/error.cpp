#include "cases/error.h"

#include "cases/json.h"

namespace rastercheck {

std::string to_string(const Error& error) {
  std::string line;
  // Any part may quote outside input: a file's name, an option, a worker's answer.
  for (const std::string& part : {cases::printable(error.file), error.place, error.reason}) {
    if (part.empty()) continue;
    if (!line.empty()) line += ": ";
    line += cases::one_line(part);
  }
  return line;
}

}  // namespace rastercheck
