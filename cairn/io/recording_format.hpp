#pragma once

/// Names in a recording, shared by who writes and who reads it.
namespace cairn::recording {

inline constexpr const char* kRun = "cairn.run";  ///< metadata record that begins a run
inline constexpr const char* kEnd = "cairn.end";  ///< metadata record of a run that came to its end
inline constexpr const char* kEstimateTopic = "/cairn/estimate";
inline constexpr const char* kPoseTopic = "/cairn/pose";

// Keys of kRun.
inline constexpr const char* kVersion = "version";
inline constexpr const char* kConfiguration = "configuration";
inline constexpr const char* kSeed = "seed";
inline constexpr const char* kStart = "T_map_base";  ///< absent: anywhere
inline constexpr const char* kMap = "map";
inline constexpr const char* kMapChecksum = "map_checksum";
inline constexpr const char* kLog = "log";
inline constexpr const char* kOdometry = "odometry_stream";
inline constexpr const char* kStreamMap = "stream_map_checksum:";  ///< followed by the path of that map
inline constexpr const char* kLive = "live";                       ///< present: a live run
// Keys of kEnd.
inline constexpr const char* kEvents = "events";
inline constexpr const char* kEstimates = "estimates";

}  // namespace cairn::recording
