#pragma once

// Members that several records have: the place of a sample, the key of a case.

#include "cases/json_members.h"
#include "cases/sample_place.h"
#include "records/case_record.h"

namespace rastercheck::records {

template <typename Archive, cases::Either<cases::SamplePlace> T>
void members(Archive& archive, T& place) {
  archive.required("triangle", place.triangle);
  archive.required("x", place.x);
  archive.required("y", place.y);
  archive.required("sample", place.sample);
}

template <typename Archive, cases::Either<CaseKey> T>
void members(Archive& archive, T& key) {
  archive.required("property", key.law);
  archive.required("backend", key.backend);
  archive.required("origin", key.origin);
  archive.required("index", key.index);
}

}  // namespace rastercheck::records
