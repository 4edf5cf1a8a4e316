#include "cases/import_process.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/error_json.h"
#include "cases/files.h"
#include "cases/internal/reader_reply.h"
#include "cases/json.h"
#include "cases/json_members.h"

namespace rastercheck::cases {

/// Here for json_members.h, which finds it by the type's namespace.
template <typename Archive, Either<ImportOptions> Options>
void members(Archive& archive, Options& options) {
  archive.optional("width", options.width);
  archive.optional("height", options.height);
  archive.optional("samples", options.samples);
  archive.optional("viewport", options.viewport);
  archive.optional("rules", options.rules);
  archive.optional("topology", options.topology);
  archive.optional("cull", options.cull);
  archive.optional("front_face", options.front_face);
  archive.optional("flat", options.flat);
  archive.optional("noperspective", options.noperspective);
  archive.optional("round", options.round);
}

namespace {

constexpr std::string_view kImported = "import";

/// The first line of an answer.
struct ImportHeader {
  std::optional<Error> error;  ///< the error that the answer has in place of a case
  std::vector<std::string> notes;
};

ImportHeader read_import_header(const JsonNode& root) {
  if (root.has("error")) return {error_from_json(root), {}};
  root.expect_object({"notes"});
  return {std::nullopt, read_as<std::vector<std::string>>(root["notes"])};
}

Result<Imported> import_file(const std::string& file, const std::string& name,
                             const ImportOptions& options) {
  const Result<std::string> text = read_text(file);
  if (!text) return tl::unexpected(text.error());
  const Importer* importer = name.empty() ? importer_of(*text) : find_importer(name);
  if (importer == nullptr) return tl::unexpected(Error{file, "", "is in no known format"});
  return importer->import(*text, file, options);
}

}  // namespace

Result<Imported> import_of_process(const std::vector<std::string>& command, const std::string& file,
                                   const ProcessLimits& limits) {
  return reply_of_reader(command, file, kImported, limits).and_then([&](const std::string& reply) {
    return import_from_reply(reply, file);
  });
}

Result<void> serve_import(const std::string& file, const std::string& importer,
                          const ImportOptions& options, const ProcessLimits& limits) {
  return serve_reply([&] { return import_to_reply(import_file(file, importer, options)); }, limits);
}

std::string to_json(const ImportOptions& options) { return json_line(json_of(options)); }

Result<ImportOptions> import_options_from_json(std::string_view text) {
  return read_json(text, "--options",
                   [](const JsonNode& root) { return read_as<ImportOptions>(root); });
}

std::string import_to_reply(const Result<Imported>& imported) {
  if (!imported) return header_line(error_to_json(imported.error()));
  return header_line({{"notes", imported->notes}}) + to_json(imported->drawn);
}

Result<Imported> import_from_reply(std::string_view reply, const std::string& file) {
  const auto refuse = [&file](const std::string& reason) {
    return tl::unexpected(reply_fault(file, kImported, reason));
  };
  std::string_view rest = reply;
  const std::optional<std::string_view> line = take_header_line(rest);
  if (!line) return refuse("no header line");
  const Result<ImportHeader> header = read_json(*line, file, &read_import_header);
  if (!header) return refuse(header.error().reason);
  if (header->error) return tl::unexpected(*header->error);
  Result<Case> c = parse_case(rest, file);
  if (!c) return refuse(c.error().reason);
  return Imported{*std::move(c), header->notes};
}

}  // namespace rastercheck::cases
