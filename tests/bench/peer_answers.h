#pragma once

// Functions shared by the programs that rastercheck-bench starts to let drivers draw. They read
// lines and answer each with one line, "ok …" or "error …" (peer_process.h).

#include <functional>
#include <iostream>
#include <sstream>
#include <string>

#include "cases/error.h"

namespace rastercheck::bench {

/// The numbers with all their digits.
template <typename... Numbers>
std::string text(Numbers... numbers) {
  std::ostringstream out;
  out.precision(17);
  ((out << numbers << ' '), ...);
  return out.str();
}

inline void say(const Result<std::string>& answer) {
  if (answer) {
    std::cout << "ok " << *answer << std::endl;
  } else {
    std::cout << "error " << to_string(answer.error()) << std::endl;
  }
}

/// Answers until the input ends.
inline void serve(const std::function<Result<std::string>(const std::string& line)>& answer) {
  for (std::string line; std::getline(std::cin, line);) say(answer(line));
}

}  // namespace rastercheck::bench
