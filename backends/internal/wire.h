#pragma once

// Converts cases, contracts, fragments and pictures to bytes, for another process of the same
// program. The bytes are not a file format and are never stored.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/contract.h"
#include "cases/draw_by.h"
#include "cases/error.h"
#include "cases/fragments.h"
#include "cases/picture.h"

namespace rastercheck::backends {

/// The questions that one process asks the other about a case.
enum class Question : std::uint8_t { promise, drawing, occlusion, picture, assembly };

struct Request {
  Question question = Question::drawing;
  cases::Case source;
  std::optional<cases::DrawBy> way = std::nullopt;        ///< the way of drawing that was asked for
  std::uint64_t occluders = 0;                            ///< for Question::occlusion
  cases::Pipeline pipeline = {};                          ///< for Question::picture
  cases::Topology topology = cases::Topology::triangles;  ///< for Question::assembly
  std::vector<std::uint32_t> indices = {};                ///< for Question::assembly
};

/// The first message of a process: describes its backend, or says why it has none.
struct Greeting {
  About about;
  std::optional<Error> problem;
};

/// The answer to a request for a drawing; an assembled one leaves out the contract.
struct DrawingAnswer {
  Drawn drawn;
  std::optional<Error> problem;
};

/// The answer to an occlusion query.
struct OcclusionAnswer {
  bool is_occluded = false;
  std::optional<Error> problem = std::nullopt;
};

/// The answer to a request for a picture.
struct PictureAnswer {
  cases::Picture picture = {};
  std::optional<Error> problem = std::nullopt;
};

std::string pack(const Request& request);
std::string pack(const Greeting& greeting);
std::string pack(const DrawingAnswer& drawing);
std::string pack(const cases::Contract& contract);
std::string pack(const OcclusionAnswer& answer);
std::string pack(const PictureAnswer& answer);

/// Decode bytes. The result is empty unless the bytes are exactly one whole value: decoding fails
/// for unknown enumerators, for lengths beyond the end, for numbers that no contract has, and for
/// an occlusion query that is about no triangle.
std::optional<Request> unpack_request(std::string_view bytes);
std::optional<Greeting> unpack_greeting(std::string_view bytes);
std::optional<DrawingAnswer> unpack_drawing(std::string_view bytes);
std::optional<cases::Contract> unpack_contract(std::string_view bytes);
std::optional<OcclusionAnswer> unpack_occlusion(std::string_view bytes);
std::optional<PictureAnswer> unpack_picture(std::string_view bytes);

}  // namespace rastercheck::backends
