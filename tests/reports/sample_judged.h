#pragma once

#include <cstdint>
#include <limits>

#include "reports/judged_page.h"

namespace rastercheck::reports {

/// A judged picture of 4 × 2 pixels and two channels, R in 8 bits and Z in float32, with a pixel of
/// every verdict except not_judged. Texts contain markup.
inline JudgedPage sample_judged() {
  using records::PixelVerdict;
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  JudgedPage page;
  page.source.name = "a <case>";
  page.source.attributes = {{"u<v", cases::Interpolation::smooth, cases::Location::sample}};
  page.view.size = {4, 2, 1};
  page.view.channels = {{"R", cases::Shown::attribute, 0, 0, 0, cases::Storage::unorm8},
                        {"Z", cases::Shown::depth, 0, 0, 1, cases::Storage::float32}};
  page.picture = {4,
                  2,
                  {"R", "Z"},
                  {cases::Storage::unorm8, cases::Storage::float32},
                  {36, 0.5F, 10, 0.25F, 0, 1, 9, kNaN, 7, 0.5F, 7, 0.5F, 7, 0.5F, 0, 1}};
  page.contract.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0.25F};
  records::JudgedPicture& judged = page.judged;
  judged.width = 4;
  judged.height = 2;
  judged.channels = page.picture.channels;
  judged.pixels = {PixelVerdict::wrong_value,  PixelVerdict::wrong_triangle, PixelVerdict::missing,
                   PixelVerdict::not_a_number, PixelVerdict::right,          PixelVerdict::right,
                   PixelVerdict::extra,        PixelVerdict::right};
  judged.steps = {5, 40, 7, std::numeric_limits<float>::infinity(), 0, 0, 70, 0};
  for (const PixelVerdict verdict : judged.pixels) {
    ++judged.counts[static_cast<std::size_t>(verdict)];
  }
  judged.worst = {
      {3,
       0,
       PixelVerdict::not_a_number,
       0,
       {{9, 9, 9, false}, {kNaN, 0.5F, 0.5F, false}},
       std::numeric_limits<double>::infinity()},
      {0, 0, PixelVerdict::wrong_value, 0, {{36, 41, 42, false}, {0.5F, 0.5F, 0.5F, false}}, 5}};
  judged.freedom = {4, 3, 1, 0};
  records::PicturePart part;
  part.width = 4;
  part.height = 2;
  for (std::size_t i = 0; i < judged.pixels.size(); ++i) {
    const float* const stored =
        page.picture.pixel(static_cast<int>(i % 4), static_cast<int>(i / 4));
    part.pixels.push_back({judged.pixels[i],
                           {stored[0], stored[1]},
                           {{0, {{41, 42, false}, {0.5F, 0.5F, false}}, judged.steps[i]},
                            {std::nullopt, {{0, 0, false}, {1, 1, false}}, 40}},
                           0});
  }
  part.outlines = {{0, {{0, 0}, {4, 0}, {0, 2}}}};
  page.parts = {part};
  page.case_file = "a <case>.json";
  page.picture_file = "a <picture>.png";
  page.judged_by = "what <somebody> promises";
  page.command = {"rastercheck", "judge", page.case_file, page.picture_file};
  page.explain = {"rastercheck", "explain", page.case_file, "--backend", "cpu"};
  return page;
}

}  // namespace rastercheck::reports
