#pragma once

// Code that all fuzz targets share. A target is one file that defines LLVMFuzzerTestOneInput for
// one reader of outside input: it gives the bytes to the reader, and checks what must hold for
// anything that the reader makes of them. libFuzzer calls this function with inputs that it
// generates; in builds without libFuzzer, replay.cpp calls it with the files it is given
// (docs/reliability.md).

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "cases/case.h"
#include "cases/error.h"

// libFuzzer's own declaration of the entry point.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace rastercheck::fuzz {

/// The bytes of an input.
std::string_view text_of(const std::uint8_t* data, std::size_t size);

/// Ends the process by abort() if a property does not hold: libFuzzer reports that as a finding.
void expect(bool holds, std::string_view property);

/// True if a text has no control character of Unicode (U+0000…U+001F, U+007F…U+009F): a terminal
/// then shows it unchanged and on one line.
bool is_one_line(std::string_view text);

/// Expects that the error is one line and has a reason.
void expect_one_line(const Error& error);

/// Expects that the case is the same to the bit after it is written and read again.
void expect_round_trip(const cases::Case& c);

}  // namespace rastercheck::fuzz
