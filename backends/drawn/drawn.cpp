// The backend `drawn:DIR`, which reads drawings that another machine made (folder.h).

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "backends/drawn/folder.h"
#include "backends/factory.h"

namespace rastercheck::backends::drawn_registration {
namespace {

class DrawnBackend : public Backend {
 public:
  DrawnBackend(std::string folder, const std::string& promised_by,
               std::unique_ptr<Backend> promiser)
      : folder_(std::move(folder)), promised_by_(promised_by), promiser_(std::move(promiser)) {}

  About about() const override {
    About about = drawn_about(promiser_->about());
    about.description = "drawings of another machine, judged by what " + promised_by_ + " promises";
    return about;
  }
  cases::Contract promise(const cases::Case& c) const override { return promiser_->promise(c); }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    const std::string lacks = cases::lacked_by(promiser_->about().capabilities, c);
    if (lacks.empty()) return read_drawing(folder_, c);
    return tl::unexpected(
        Error{"", "", promised_by_ + " does not draw " + lacks, Failure::unsupported});
  }

  std::string folder_;
  std::string promised_by_;
  std::unique_ptr<Backend> promiser_;
};

Result<std::unique_ptr<Backend>> make(const std::string& folder) {
  const Result<DrawnCampaign> campaign = read_drawn_campaign(folder);
  if (!campaign) return tl::unexpected(campaign.error());
  const std::string& promised_by = campaign->plan.backends.front();
  if (promised_by.starts_with("drawn:")) {
    return tl::unexpected(
        Error{folder + "/campaign.json", "/plan/backends/0", "must draw, and not read drawings"});
  }
  return make_backend(promised_by).map([&](std::unique_ptr<Backend>&& promiser) {
    return std::unique_ptr<Backend>(
        std::make_unique<DrawnBackend>(folder, promised_by, std::move(promiser)));
  });
}

std::vector<Listing> list() {
  return {{"drawn:DIR", "drawings of the cases of rastercheck cases --out DIR",
           "DIR must name the folder"}};
}

// Another machine's files may hold anything, so they are read in a separate process.
const BackendRegistration kRegistration({"drawn", &make, &list, true});

}  // namespace
}  // namespace rastercheck::backends::drawn_registration
