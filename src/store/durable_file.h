// Small files that are either wholly there or not at all, and that tell when they were damaged.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "drover/result.h"
#include "store/files.h"

namespace drover::store {

/// A sentence that says what did not work and why.
struct Failure {
  std::string text;
};

/// FNV-1a, 64 bits: finds accidents, does not stop an attacker.
std::uint64_t fingerprint(std::string_view text);

/// One JSON object that names its format, its version and the fingerprint of `body` (JSON text).
std::string seal(std::string_view format, int version, std::string_view body);
/// The body of a sealed text, or a sentence that says what is wrong with it.
Result<std::string, Failure> unseal(std::string_view format, int version, std::string_view text);
/// The begin of the body of which `front` is the begin: as it lies there, for without its end no
/// fingerprint can be compared.
Result<std::string_view, Failure> unseal_front(std::string_view format, int version,
                                               std::string_view front);

/// Replaces `folder/name`: a temporary file beside it, written, synced, renamed over it, and the
/// folder synced. Returns nothing on success: then it survives a power cut. After an error the old
/// or the new content is there, never a mixture; a failed sync is never tried again on the same
/// file, because the kernel forgets what it could not write.
/// The failure names the step, the path and the system's words.
std::optional<Failure> write_durably(Files& files, const std::string& folder,
                                     const std::string& name, std::string_view content);

/// "cannot write /path: No space left on device"
std::string failure_text(std::string_view step, const std::string& path, int error);

/// Whether a file could not be read because it is not ours: it is as good as ever, and nothing may
/// be put in its place.
bool is_foreign(int error);
/// "/folder/name belongs to another user: sudo chown -R drover: /folder"; and what then.
std::string foreign_text(const std::string& folder, const std::string& name);

/// Renames a file that cannot be used to `<name>.bad` (or .bad2, ...) so that nothing is lost.
/// @return the new name
Result<std::string, Failure> quarantine(Files& files, const std::string& folder,
                                        const std::string& name);
/// The same, in words: "kept as NAME.bad", or why not even that.
std::string put_aside(Files& files, const std::string& folder, const std::string& name);
/// One of this name was put aside, and lies there still.
bool lies_aside(Files& files, const std::string& folder, const std::string& name);

/// Temporary files carry this ending; one that is found at start was never acknowledged.
inline constexpr std::string_view kTemporaryEnding = ".tmp";

}  // namespace drover::store
