#include "properties/inspect/looks.h"

#include "properties/inspect/run_inspections.h"
#include "properties/inspect/specimens.h"

namespace rastercheck::properties {

void look_closely(records::Run& run, const CaseSources& sources,
                  const backends::BackendFactory& backends) {
  CaseDrawer drawer(backends);
  run.inspections = inspect_run(run, sources, drawer);
  run.specimens = make_specimens(run, sources, drawer);
}

}  // namespace rastercheck::properties
