#pragma once

// Reads the logs (.qpa) of dEQP, Khronos' conformance tests. From each rasterization test, takes
// the triangles that were drawn, the picture that the test judged, and its verdict.
//
// Such a log is lines of text and one XML document for each test:
//
//   #beginTestCaseResult dEQP-GLES3.functional.rasterization.primitives.triangles
//   <?xml version="1.0" encoding="UTF-8"?>
//   <TestCaseResult Version="0.3.4" CasePath="…" CaseType="SelfValidate">
//    <Text>SUBPIXEL_BITS = 8</Text>
//    <Section Name="Test iteration 1 / 3" Description="…">
//     <Text>Rendering 2 triangle(s):</Text>
//     <Text>Triangle 1:
//       (0.2, 0.8, 0, 1)
//       …</Text>
//     <ImageSet Name="Verification result" Description="Result of rendering">
//      <Image Name="Result" Width="256" Height="256" Format="RGBA8888" CompressionMode="PNG" …>
//      iVBORw0KGgo…</Image>
//     …
//    <Result StatusCode="Pass">Pass</Result>
//   </TestCaseResult>
//   #endTestCaseResult
//
// Limits of a log. Numbers are printed with six significant digits, so a number with all six may be
// off by half a unit of the last one. Shorter numbers are literals of the test's source, and exact.
// The tests of fill rules and culling print no positions. Logs never contain the positions of
// samples, and logs of Vulkan tests do not contain the subpixel bits.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/topology.h"

namespace rastercheck::cases {

/// A number from the log: the float32 nearest to the printed number, and how far the number that
/// was drawn may be from it.
struct DeqpNumber {
  float value = 0;
  double uncertainty = 0;
};

struct DeqpVertex {
  std::array<DeqpNumber, 4> position;  ///< clip x, y, z, w
  /// Red, green, blue and alpha; empty if the test draws everything in white.
  std::optional<std::array<DeqpNumber, 4>> color;
};

/// An image in the log, still encoded.
struct DeqpImage {
  int width = 0;
  int height = 0;
  bool is_png = false;  ///< if false, `bytes` are rows of RGB or RGBA
  std::string bytes;
  int channels = 0;  ///< 3 or 4
};

/// One drawing of a test, and the picture of this drawing that the test judged.
struct DeqpDrawing {
  std::string section;  ///< "Test iteration 1 / 3"; empty outside of sections
  Topology topology = Topology::triangles;
  std::vector<DeqpVertex> vertices;
  DeqpImage image;
};

struct DeqpTest {
  std::string path;    ///< "dEQP-GLES3.functional.…"
  std::string status;  ///< "Pass", "Fail", "QualityWarning"…; empty if the log has none
  std::vector<DeqpDrawing> drawings;
  std::optional<int> subpixel_bits;  ///< as the driver reports; empty for Vulkan tests
  /// Why the log does not suffice to judge the test: drawings are missing, or facts about them are.
  /// Empty if the log suffices.
  std::string reason;

  bool is_vulkan() const { return path.starts_with("dEQP-VK"); }
};

/// Reads all tests of a log; `file` is the name used in errors. Tests that draw no triangles get no
/// drawings, and a reason. Fails if the text is not a log, or if a test's document is malformed.
Result<std::vector<DeqpTest>> parse_deqp_log(std::string_view text, const std::string& file);

/// The case of a drawing, with its picture's layout. Attributes are r, g and b, if vertices have
/// colours.
Case case_of(const DeqpTest& test, const DeqpDrawing& drawing);

/// How far the drawing may be from the log's numbers, because they have too few digits.
struct DeqpUncertainty {
  double pixels = 0;   ///< largest error of a vertex's window x or y, in pixels
  double weights = 0;  ///< largest error of a smooth value, as a share of its range
};

/// Empty if a vertex may be anywhere, because the digits do not exclude w = 0.
std::optional<DeqpUncertainty> uncertainty_of(const DeqpDrawing& drawing);

}  // namespace rastercheck::cases
