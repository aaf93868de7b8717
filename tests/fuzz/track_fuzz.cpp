// Any bytes as a track file: no crash, what is read is the same when it is stored and read again,
// and a stored file with a changed byte is refused.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "store/durable_file.h"
#include "store/track_file.h"

namespace {

using namespace drover;
using namespace drover::store;

void require(bool holds) {
  if (!holds) std::abort();
}

bool same(const TrackPoint& a, const TrackPoint& b) {
  return a.longitude_deg == b.longitude_deg && a.latitude_deg == b.latitude_deg &&
         a.angle_deg == b.angle_deg && a.x_m == b.x_m && a.y_m == b.y_m && a.yaw_rad == b.yaw_rad &&
         a.z_m == b.z_m;
}

void check_name(const std::string& file) {
  require(file.size() <= 200 && file.starts_with("t-") && file.ends_with(kTrackEnding));
  for (const char c : file) require(static_cast<unsigned char>(c) > 0x20 && c != 0x7F && c != '/');
}

void check_track(std::string_view content) {
  const auto track = decode_track(content);
  if (!track.ok()) {
    require(!track.error().text.empty());
    return;
  }
  check_name(track_file_name(track->name));
  check_name(track_file_name(track->name, 1));
  for (const TrackPoint& p : track->points)
    require(std::isfinite(p.longitude_deg) && std::isfinite(p.latitude_deg) &&
            std::isfinite(p.angle_deg) && std::isfinite(p.x_m) && std::isfinite(p.y_m) &&
            std::isfinite(p.yaw_rad) && std::isfinite(p.z_m));
  std::string stored = encode_track(*track);
  const auto again = decode_track(stored);
  require(again.ok() && again->name == track->name && again->points.size() == track->points.size());
  for (std::size_t i = 0; i < track->points.size(); ++i)
    require(same(again->points[i], track->points[i]));
  require(again->origin.has_value() == track->origin.has_value());
  if (track->origin)
    require(again->origin->latitude_deg == track->origin->latitude_deg &&
            again->origin->longitude_deg == track->origin->longitude_deg &&
            again->origin->altitude_m == track->origin->altitude_m);
  // Whatever byte changes on the disk, the file is not taken for whole.
  stored[content.size() * 31 % stored.size()] ^= 1;
  require(!decode_track(stored).ok());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 || size > 8192) return 0;
  // The first byte chooses whether the rest is a whole file, or what a checksum is put around.
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  check_track(data[0] % 2 == 0 ? std::string(text) : seal("drover-track", 1, text));
  return 0;
}
