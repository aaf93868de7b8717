// How a track lies on disk: its file name and its content.
#pragma once

#include <string>
#include <string_view>

#include "drover/result.h"
#include "store/durable_file.h"
#include "store/track.h"

namespace drover::store {

inline constexpr std::string_view kTrackEnding = ".json";
/// Room for what the largest command (2 MiB) carries: a file spells no keys.
inline constexpr std::size_t kMaxTrackFileBytes = (std::size_t{2} << 20) + (std::size_t{1} << 16);

/// A file name for any track name: lower-case letters, digits, `_`, `-` stay, all other bytes
/// become %xx, so it never leaves its folder and two names never share it by case or normalisation.
/// Long names are cut and end in `~` and a fingerprint. `attempt` > 0 gives another name, for the
/// case that two long names share the fingerprint.
std::string track_file_name(std::string_view name, int attempt = 0);

std::string encode_track(const Track& track);
/// The failure says what is wrong with the file, without its name.
Result<Track, Failure> decode_track(std::string_view content);

}  // namespace drover::store
