#pragma once

// Cases, contracts and framebuffers as bytes, for another process of the same program. They are no
// format: nothing of them is kept.

#include <optional>
#include <string>
#include <string_view>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/contract.h"
#include "cases/draw_by.h"
#include "cases/error.h"
#include "cases/fragments.h"

namespace rastercheck::backends {

/// What a process is asked about a case.
enum class Question : std::uint8_t { promise, drawing };

struct Request {
  Question question = Question::drawing;
  cases::Case source;
  std::optional<cases::DrawBy> way = std::nullopt;  ///< that is asked for
};

/// What a process says first: who it is, or why there is no backend.
struct Greeting {
  About about;
  std::optional<Error> problem;
};

/// The answer to a drawing.
struct DrawingAnswer {
  Drawn drawn;
  std::optional<Error> problem;
};

std::string pack(const Request& request);
std::string pack(const Greeting& greeting);
std::string pack(const DrawingAnswer& drawing);
std::string pack(const cases::Contract& contract);

/// Nothing where the bytes are not those of one, whole: enumerators that there are not, lengths
/// beyond what is there, numbers that no contract has.
std::optional<Request> unpack_request(std::string_view bytes);
std::optional<Greeting> unpack_greeting(std::string_view bytes);
std::optional<DrawingAnswer> unpack_drawing(std::string_view bytes);
std::optional<cases::Contract> unpack_contract(std::string_view bytes);

}  // namespace rastercheck::backends
