// Programs that store, blend or multiply wrongly: each picture must be judged wrong under an exact
// contract and under a contract with 8 subpixel bits. Without the defect, it must be right.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "oracle/picture_judge.h"
#include "tests/oracle/pictures.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::picture_defects_test {
namespace {

using cases::Alpha;
using cases::Blend;
using cases::Storage;

/// How a program makes a picture of 8-bit channels R, G and A. The defaults are free of defects.
struct Program {
  Storage storage = Storage::unorm8;
  Alpha alpha = Alpha::straight;
  Blend blend = Blend::off;
  bool truncates = false;             ///< rounds codes down
  bool encodes_first = false;         ///< sRGB: blends codes, not the numbers they stand for
  int rows_off = 0;                   ///< number of rows by which the picture is too low
  int times_multiplied = 1;           ///< how often premultiplied colours are multiplied by alpha
  bool multiplies_background = true;  ///< by its alpha, if colours are premultiplied
  bool swaps_weights = false;         ///< weights: a for the background, 1 − a for the colour
  bool encodes_alpha = false;         ///< sRGB: encodes alpha like colours
};

class Painter {
 public:
  explicit Painter(const Program& program) : program_(&program) {}

  double encoded(double n) const {
    if (program_->storage != Storage::srgb8) return n;
    return n <= 0.0031308 ? 12.92 * n : 1.055 * std::pow(n, 1 / 2.4) - 0.055;
  }
  double decoded(double n) const {
    if (program_->storage != Storage::srgb8) return n;
    return n <= 0.04045 ? n / 12.92 : std::pow((n + 0.055) / 1.055, 2.4);
  }
  float code(double encoded_number) const {
    const double scaled = 255 * std::clamp(encoded_number, 0.0, 1.0);
    return static_cast<float>(std::floor(scaled + (program_->truncates ? 0 : 0.5)));
  }

  float background(double color, double alpha) const {
    const bool multiplies =
        program_->alpha == Alpha::premultiplied && program_->multiplies_background;
    return code(encoded(multiplies ? color * alpha : color));
  }
  float alpha(double a, double background) const {
    const double held = code(background) / 255.0;
    const double sum = program_->blend == Blend::over ? a + (1 - a) * held : a;
    return code(program_->encodes_alpha ? encoded(sum) : sum);
  }
  float color(double c, double a, float background) const {
    const int times = program_->alpha == Alpha::premultiplied ? program_->times_multiplied
                      : program_->blend == Blend::over        ? 1
                                                              : 0;
    const double source_weight = program_->swaps_weights ? 1 - a : std::pow(a, times);
    if (program_->blend == Blend::off) return code(encoded(c * source_weight));
    const double rest = program_->swaps_weights ? a : 1 - a;
    if (program_->encodes_first) {
      return code(source_weight * encoded(c) + rest * background / 255.0);
    }
    return code(encoded(c * source_weight + rest * decoded(background / 255.0)));
  }

 private:
  const Program* program_;
};

constexpr float kRed = 0.3F;
constexpr float kGreen = 0.9F;
constexpr float kBackgroundAlpha = 0.6F;

cases::PictureLayout layout_of(const Program& program) {
  cases::PictureLayout layout;
  layout.storage = program.storage;
  layout.alpha = program.alpha;
  layout.blend = program.blend;
  layout.channels = {{"R", "a0", kRed}, {"G", "a1", kGreen}, {"A", "a2", kBackgroundAlpha}};
  return layout;
}

/// The picture that the program makes of a drawing.
cases::PictureFile picture_by(const Program& program, const cases::PictureFile& plan,
                              const cases::Fragments& drawn) {
  cases::PictureFile picture = plan;
  const Painter painter(program);
  const std::array background{painter.background(kRed, kBackgroundAlpha),
                              painter.background(kGreen, kBackgroundAlpha),
                              painter.code(kBackgroundAlpha)};
  picture.values.clear();
  for (int i = 0; i < picture.width * picture.height; ++i) {
    picture.values.insert(picture.values.end(), background.begin(), background.end());
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const int row = drawn.y[i] + program.rows_off;
    if (row >= picture.height) continue;
    const auto at = static_cast<std::size_t>((row * picture.width + drawn.x[i]) * 3);
    const auto shown = drawn.attributes_of(i);
    picture.values[at] = painter.color(shown[0], shown[2], background[0]);
    picture.values[at + 1] = painter.color(shown[1], shown[2], background[1]);
    picture.values[at + 2] = painter.alpha(shown[2], kBackgroundAlpha);
  }
  return picture;
}

/// A triangle in perspective, whose colours and alpha vary, on most of 24 × 20 pixels.
cases::Case colored_case() {
  return small_case(
      cases::Rules::vulkan, 24, 20,
      {{{-0.9F, -0.95F, 0.25F, 1}, {2.7F, -2.5F, 0.5F, 3}, {-0.75F, 1.4F, 0.5F, 1.5F}}},
      {{{0.1F, 0.9F, 0.3F}, {0.8F, 0.2F, 0.9F}, {0.5F, 0.6F, 0.1F}}});
}

/// The same case, but each vertex may lie on any point of a 1/256-pixel grid within one unit.
cases::Case snapped_case() {
  cases::Case c = colored_case();
  c.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0};
  c.basis = cases::Basis::unspecified;
  return c;
}

struct Verdict {
  std::uint64_t wrong = 0;
  std::uint64_t right = 0;
};

Verdict judged_picture(const cases::Case& c, const Program& program) {
  const SceneTruth scene(c, cases::contract_of(c));
  const ShownPicture perfect = perfect_picture(scene, layout_of(program));
  const cases::PictureFile picture = picture_by(program, perfect.file, oracle::perfect(scene));
  const records::JudgedPicture judged = judge_picture(scene, perfect.view, picture);
  return {judged.wrong(), judged.count(records::PixelVerdict::right)};
}

struct Defect {
  std::string name;
  Program program;
};

/// Each storage, alpha and blend without a defect.
std::vector<Program> sound_programs() {
  std::vector<Program> programs;
  for (const Storage storage : {Storage::unorm8, Storage::srgb8}) {
    for (const Alpha alpha : {Alpha::straight, Alpha::premultiplied}) {
      for (const Blend blend : {Blend::off, Blend::over}) {
        programs.push_back({.storage = storage, .alpha = alpha, .blend = blend});
      }
    }
  }
  return programs;
}

std::vector<Defect> defects() {
  std::vector<Defect> all;
  for (const Program& sound : sound_programs()) {
    const auto add = [&](std::string name, const auto& damage) {
      Program program = sound;
      damage(program);
      name += sound.storage == Storage::srgb8 ? ", sRGB" : ", unorm";
      name += sound.alpha == Alpha::premultiplied ? ", premultiplied" : "";
      name += sound.blend == Blend::over ? ", blended" : "";
      all.push_back({std::move(name), program});
    };
    add("truncates", [](Program& p) { p.truncates = true; });
    add("a row too low", [](Program& p) { p.rows_off = 1; });
    if (sound.alpha == Alpha::premultiplied) {
      add("multiplied twice", [](Program& p) { p.times_multiplied = 2; });
      add("not multiplied", [](Program& p) { p.times_multiplied = 0; });
      add("background not multiplied", [](Program& p) { p.multiplies_background = false; });
    }
    if (sound.storage == Storage::srgb8) {
      add("encodes alpha", [](Program& p) { p.encodes_alpha = true; });
    }
    if (sound.blend == Blend::off) continue;
    add("weights swapped", [](Program& p) { p.swaps_weights = true; });
    if (sound.storage == Storage::srgb8) {
      add("encodes before it blends", [](Program& p) { p.encodes_first = true; });
    }
  }
  return all;
}

TEST(PictureDefects, SoundProgramsAreRight) {
  for (const cases::Case& c : {colored_case(), snapped_case()}) {
    for (const Program& program : sound_programs()) {
      const Verdict verdict = judged_picture(c, program);
      EXPECT_EQ(verdict.wrong, 0U);
      EXPECT_EQ(verdict.right, 24U * 20U);
      // A second way to make the same picture.
      const SceneTruth scene(c, cases::contract_of(c));
      const ShownPicture other = perfect_picture(scene, layout_of(program));
      EXPECT_EQ(picture_by(program, other.file, perfect(scene)).values, other.file.values);
    }
  }
}

TEST(PictureDefects, AreSeenUnderAnExactContract) {
  for (const Defect& defect : defects()) {
    EXPECT_GT(judged_picture(colored_case(), defect.program).wrong, 0U) << defect.name;
  }
}

TEST(PictureDefects, AreSeenUnderEightSubpixelBits) {
  for (const Defect& defect : defects()) {
    const Verdict verdict = judged_picture(snapped_case(), defect.program);
    EXPECT_GT(verdict.wrong, 0U) << defect.name;
  }
}

}  // namespace
}  // namespace rastercheck::oracle::picture_defects_test
