#pragma once

// Reads the logs (.qpa) of dEQP, Khronos' conformance tests: what the tests of rasterization say
// they have drawn, the picture that they judged, and their verdict.
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
// Limits of a log. Clip positions have six significant digits, so a number with all six may be off
// by half a unit of the last one; tests with numbers written by hand have fewer, which are exact.
// The tests of fill rules and of culling print no positions. Positions of samples, and with Vulkan
// also the subpixel bits, are not in the log.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::cases {

/// How vertices form triangles.
enum class DeqpTopology { list, strip, fan };

/// A number as printed: the float32 nearest to it, and how far the printed number may be from the
/// one that was drawn.
struct DeqpNumber {
  float value = 0;
  double uncertainty = 0;
};

struct DeqpVertex {
  std::array<DeqpNumber, 4> position;  ///< clip x, y, z, w
  /// Red, green, blue and alpha; empty where all that is drawn is white.
  std::optional<std::array<DeqpNumber, 4>> color;
};

/// An image in the log, still encoded.
struct DeqpImage {
  int width = 0;
  int height = 0;
  bool is_png = false;  ///< else rows of bytes, RGB or RGBA
  std::string bytes;
  int channels = 0;  ///< 3 or 4
};

/// One drawing of a test, and the picture of it that the test judged.
struct DeqpDrawing {
  std::string section;  ///< "Test iteration 1 / 3"; empty outside of sections
  DeqpTopology topology = DeqpTopology::list;
  std::vector<DeqpVertex> vertices;
  DeqpImage image;
};

struct DeqpTest {
  std::string path;    ///< "dEQP-GLES3.functional.…"
  std::string status;  ///< "Pass", "Fail", "QualityWarning"…; empty if the log ends before
  std::vector<DeqpDrawing> drawings;
  std::optional<int> subpixel_bits;  ///< as the driver reports; not in logs of Vulkan tests
  /// Why the drawings are not all that the test judged, or cannot be judged by what the log says.
  /// Empty if they can be.
  std::string reason;

  bool is_vulkan() const { return path.starts_with("dEQP-VK"); }
};

/// Reads all tests of a log; `file` is the name used in errors. Tests of other things have no
/// drawings, and a reason. Fails where the text is no log, or a test's document is broken.
Result<std::vector<DeqpTest>> parse_deqp_log(std::string_view text, const std::string& file);

/// The case of a drawing, with its picture's layout. Attributes are r, g and b, if vertices have
/// colours.
Case case_of(const DeqpTest& test, const DeqpDrawing& drawing);

/// How far the log's digits leave a drawing open.
struct DeqpUncertainty {
  double pixels = 0;   ///< window x and y of a vertex, in pixels
  double weights = 0;  ///< a vertex's share of a smooth value, as a share of it
};

/// Empty if they leave a vertex anywhere, because its w may be 0.
std::optional<DeqpUncertainty> uncertainty_of(const DeqpDrawing& drawing);

}  // namespace rastercheck::cases
