// The backend `vulkan`: any device that the Vulkan loader finds. `vulkan` is the machine's best
// device, `vulkan:N` the one with index N (from 0), `vulkan:NAME` one whose name contains NAME.
// `vulkan:lavapipe` and `vulkan:swiftshader` are drivers that draw on the CPU, whose files are
// where Debian puts them. `,validate` after any of these turns on the validation layer. Any message
// from that layer fails the case.

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backends/api_promise.h"
#include "backends/factory.h"
#include "backends/upright_viewport.h"
#include "backends/vulkan/internal/case_drawing.h"
#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/drawing_resources.h"
#include "backends/vulkan/internal/open_device.h"
#include "backends/vulkan/internal/picture_drawing.h"
#include "backends/vulkan/limits.h"
#include "cases/json.h"

namespace rastercheck::backends {
namespace {

using vulkan::CaseDrawing;
using vulkan::Device;
using vulkan::DrawingResources;
using vulkan::PictureDrawing;

class VulkanBackend : public Backend, public WaysOfDrawing, public PictureDrawer, public Assembler {
 public:
  VulkanBackend(std::string specification, std::unique_ptr<Device> device,
                std::unique_ptr<DrawingResources> resources, CaseDrawing drawing)
      : specification_(std::move(specification)),
        device_(std::move(device)),
        resources_(std::move(resources)),
        drawing_(std::move(drawing)),
        picture_drawing_(*resources_) {}

  About about() const override {
    return {
        .description = device_->description(),
        .driver = device_->driver(),
        .api = ApiLimits{device_->limits().subpixel_bits, device_->is_software(),
                         device_->limits().viewport_subpixel_bits, device_->limits().subtexel_bits},
        .has_limits = true,
        .capabilities = vulkan::drawable(device_->limits()),
        .ways = ways(),
        .draws_pictures = true,
        .assembles = true};
  }
  Assembler* assembler() override { return this; }
  Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                          std::span<const std::uint32_t> indices) override {
    const auto upright = with_upright_viewport(c, NegativeSizes::height);
    const cases::Case& drawn = upright ? *upright : c;
    const std::string missing = vulkan::lacks(device_->limits(), drawn);
    if (!missing.empty()) return lacking(missing);
    return checked(drawing_.draw_assembled(drawn, topology, indices, [this] { go_on(); }));
  }
  WaysOfDrawing* ways_of_drawing() override { return this; }
  std::vector<cases::DrawBy> ways() const override { return drawing_.ways(); }
  Result<cases::Fragments> draw_by(const cases::Case& c, cases::DrawBy way) override {
    return draw_in(c, way);
  }
  PictureDrawer* picture_drawer() override { return this; }
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override {
    const auto upright = with_upright_viewport(c, NegativeSizes::height);
    const cases::Case& drawn = upright ? *upright : c;
    std::string missing = vulkan::lacks(device_->limits(), drawn);
    if (missing.empty()) missing = vulkan::lacks_for_picture(device_->limits(), drawn, pipeline);
    if (!missing.empty()) return lacking(missing);
    return checked(picture_drawing_.draw(drawn, pipeline, [this] { go_on(); }));
  }
  cases::Contract promise(const cases::Case& c) const override {
    return api_promise(c, *about().api, *driver_promise());
  }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    return draw_in(c, std::nullopt);
  }

  Result<cases::Fragments> draw_in(const cases::Case& c, std::optional<cases::DrawBy> way) {
    if (const auto upright = with_upright_viewport(c, NegativeSizes::height)) {
      return draw_in(*upright, way);
    }
    const std::string missing = vulkan::lacks(device_->limits(), c);
    if (!missing.empty()) return lacking(missing);
    return checked(drawing_.draw(c, way, [this] { go_on(); }));
  }

  tl::unexpected<Error> lacking(const std::string& missing) const {
    return fail({"", "", "it lacks " + missing, Failure::unsupported});
  }

  /// Fails if the validation layer said anything about the drawing.
  template <typename Drawing>
  Result<Drawing> checked(Result<Drawing> drawn) const {
    const std::string said = device_->take_messages();
    if (!said.empty()) return fail({"", "", "the validation layer says: " + cases::one_line(said)});
    if (!drawn) return fail(drawn.error());
    return drawn;
  }

  tl::unexpected<Error> fail(Error error) const {
    error.file = specification_;
    return tl::unexpected(std::move(error));
  }

  std::string specification_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<DrawingResources> resources_;
  CaseDrawing drawing_;
  PictureDrawing picture_drawing_;
};

Result<std::unique_ptr<Backend>> make_on(const std::string& specification, Device opened) {
  auto device = std::make_unique<Device>(std::move(opened));
  Result<DrawingResources> made = DrawingResources::create(*device);
  if (!made) return tl::unexpected(made.error());
  auto resources = std::make_unique<DrawingResources>(*std::move(made));
  Result<CaseDrawing> drawing = CaseDrawing::create(*resources);
  if (!drawing) return tl::unexpected(drawing.error());
  return std::make_unique<VulkanBackend>(specification, std::move(device), std::move(resources),
                                         *std::move(drawing));
}

Result<std::unique_ptr<Backend>> make(const std::string& options) {
  const std::string specification = "vulkan" + (options.empty() ? "" : ":" + options);
  Result<Device> device = vulkan::open_device(options);
  Result<std::unique_ptr<Backend>> made =
      device ? make_on(specification, *std::move(device)) : tl::unexpected(device.error());
  if (made) return made;
  Error error = made.error();
  error.file = specification;
  error.failure = Failure::unavailable;
  return tl::unexpected(std::move(error));
}

std::vector<Listing> list() {
  std::vector<Listing> rows{{"vulkan", "a Vulkan driver"}};
  for (const std::string_view driver : vulkan::driver_names()) {
    rows.push_back({fmt::format("vulkan:{}", driver), "a Vulkan driver"});
  }
  return rows;
}

const BackendRegistration kRegistration({"vulkan", &make, &list, true});

}  // namespace
}  // namespace rastercheck::backends
