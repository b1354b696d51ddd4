// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "identify/fit/run_log.hpp"

namespace catena {

/// What a process does of the work of one identification: all of it, a shard, or, to merge, nothing but
/// what comes after.
struct WorkPart {
  Shard shard;                   ///< its pieces of work
  std::size_t of = 0;            ///< shards; 0: the work is not shared
  std::filesystem::path output;  ///< of the whole identification

  bool is_shard() const { return of > 0 && shard.of > 0; }
  bool is_merge() const { return of > 0 && shard.of == 0; }
  /// FOLDER of the identification, or FOLDER/shard_3_of_8.
  std::filesystem::path folder() const;
};

/// The part that --shard names, "3/8": the third of eight. Throws InputError for what is none.
WorkPart named_shard(const std::string& shard, const std::filesystem::path& output);

/// To merge the shards in `output`. Throws InputError where there are none, where one is missing, and
/// where they are of different numbers.
WorkPart merge_in(const std::filesystem::path& output);

/// Lets the log know what other shards have finished so far. Throws InputError as RunLog::take_over
/// does.
void take_over_others(RunLog& log, const WorkPart& part);

/// Refused to merge as a start (counted from 0) is missing.
InputError start_is_missing(std::size_t start, const WorkPart& part);

/// What follows a fit, as it was asked for.
struct RefitsAsked {
  int bootstrap = 0;
  bool profiles = false;
};
/// Writes down that a shard has finished these refits.
void note_end(RunLog& log, const WorkPart& part, const FitResult& fit, const RefitsAsked& asked);
/// Throws InputError unless all shards have finished these.
void require_ends(const RunLog& log, const WorkPart& part, const FitResult& fit,
                  const RefitsAsked& asked);

}  // namespace catena
