#pragma once

// Reads mesh files with assimp in a separate process: a crash, a hang or excessive memory use over
// a broken file becomes an error of the file, and the process's answer is checked like any input.
// The answer is one line of JSON followed by the mesh's numbers, little-endian, without separators:
//
//   {"vertices": 3, "triangles": 1, "textured": true, "cameras": [{"name": "front", "yfov": …}]}
//   x y z of every vertex, u v of every vertex where textured (float32), corners of every triangle
//   (uint32)
//
// without "cameras" if the file has none,
// or one line alone, {"error": {"file": "…", "place": "…", "reason": "…"}}.
//
// This keeps a broken file from bringing the program down. It is no sandbox: the process has all
// rights of the user except to write files.

#include <string>
#include <string_view>
#include <vector>

#include "cases/error.h"
#include "cases/mesh.h"
#include "cases/reader_process.h"

namespace rastercheck::cases {

/// Returns the mesh that `command` (program and arguments) reads; the command must call
/// serve_mesh(). `file` is the name used in errors.
Result<Mesh> mesh_of_process(const std::vector<std::string>& command, const std::string& file,
                             const ProcessLimits& limits);

/// The child's side: limits this process, reads the mesh (mesh_reader.h) and writes it, or the
/// error, to the original standard output. Anything printed meanwhile goes to standard error.
Result<void> serve_mesh(const std::string& file, const std::string& format,
                        const ProcessLimits& limits);

/// Formats the child's answer.
std::string mesh_to_reply(const Result<Mesh>& mesh);

/// Parses an answer: returns its mesh or its error. An invalid answer is an error of `file`.
Result<Mesh> mesh_from_reply(std::string_view reply, const std::string& file);

}  // namespace rastercheck::cases
