#pragma once

// Mesh files, read by assimp in a process of its own: one that crashes, hangs or eats memory over a
// broken file is an error of the file, and nothing is believed of what it says. What was read comes
// back as a line of JSON and the mesh's numbers behind it, little-endian, none between them:
//
//   {"vertices": 3, "triangles": 1, "textured": true}
//   x y z of every vertex, u v of every vertex where textured (float32), corners of every triangle
//   (uint32)
//
// or as a line alone, {"error": {"file": "…", "place": "…", "reason": "…"}}.
//
// This keeps a broken file from taking the program with it. It is no sandbox: the process has all
// rights of the user but that to write files.

#include <string>
#include <string_view>
#include <vector>

#include "cases/child_process.h"
#include "cases/error.h"
#include "cases/mesh.h"

namespace rastercheck::cases {

/// Half of the machine's memory and two minutes: more than any mesh takes that can be drawn.
ProcessLimits default_mesh_limits();

/// The mesh that `command` (program and arguments) says it has read; it is to call serve_mesh().
/// `file` is the name for errors.
Result<Mesh> mesh_of_process(const std::vector<std::string>& command, const std::string& file,
                             const ProcessLimits& limits);

/// The other end: limits this process, reads the mesh (mesh_reader.h) and writes it, or why it
/// cannot be read, to what was standard output. What is printed meanwhile goes to standard error.
Result<void> serve_mesh(const std::string& file, const std::string& format,
                        const ProcessLimits& limits);

/// What a process answers.
std::string mesh_to_reply(const Result<Mesh>& mesh);

/// The mesh of an answer, or the error that it holds, or, of the name `file`, what is wrong with
/// it.
Result<Mesh> mesh_from_reply(std::string_view reply, const std::string& file);

}  // namespace rastercheck::cases
