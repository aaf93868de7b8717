// The origin of the map frame on disk: it survives a restart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drover/path.h"
#include "json/json_text.h"
#include "json/located_json.h"
#include "store/durable_file.h"
#include "store/files.h"

namespace drover::store {

/// `null`, or degrees and metres by name.
void write_origin(json::JsonText& out, const std::optional<GeodeticPoint>& origin);
/// Nothing when a number is missing or the latitude or longitude is impossible.
std::optional<GeodeticPoint> read_origin(const json::Node& node);

class OriginStore final {
 public:
  /// `files` is borrowed for the lifetime of this object; `folder` exists.
  OriginStore(Files& files, std::string folder);

  /// Nothing when none was ever stored. A file that cannot be used is put aside and reported; one
  /// that was deleted is reported.
  std::optional<GeodeticPoint> load(std::vector<std::string>& report);
  /// Why there is none though one was stored, for operators; empty when there is one, or never was.
  /// Stored tracks belong to the lost one, so a person gives the new one.
  const std::string& problem() const { return problem_; }
  /// Returns nothing when it is durable.
  std::optional<Failure> save(const GeodeticPoint& origin);

 private:
  Files& files_;
  std::string folder_;
  std::string problem_;
};

}  // namespace drover::store
