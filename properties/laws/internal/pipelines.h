#pragma once

// Chooses pipelines for laws about pictures.

#include <string>
#include <string_view>

#include "cases/case.h"
#include "cases/picture.h"

namespace rastercheck::properties {

/// Chooses a pipeline without a texture by the case's pseudorandom number (choices.h): depth
/// function and write mask, clear depth, blend, format, resolve, and whether attributes are
/// channels or vertex colours.
cases::Pipeline pipeline_of(const cases::Case& c);

/// The pipeline in words, for notes.
std::string text_of(const cases::Pipeline& pipeline);

std::string_view word_of(cases::DepthFunction function);
std::string_view word_of(cases::Blend blend);

}  // namespace rastercheck::properties
