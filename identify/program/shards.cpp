// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/shards.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <regex>
#include <set>

#include "common/in_quotes.hpp"

namespace catena {
namespace {

/// What the expression finds in the text: two whole numbers I and N with 1 <= I <= N.
std::optional<Shard> shard_in(const std::string& text, const char* expression) {
  std::smatch found;
  if (!std::regex_match(text, found, std::regex(expression))) return std::nullopt;
  const unsigned long part = std::stoul(found[1].str()), of = std::stoul(found[2].str());
  if (part < 1 || part > of) return std::nullopt;
  return Shard{part - 1, of};
}

std::string name_of(const Shard& shard) {
  return fmt::format("shard_{}_of_{}", shard.part + 1, shard.of);
}

std::filesystem::path log_of(std::size_t shard, const WorkPart& all) {
  return all.output / name_of({shard, all.of}) / "run.log";
}

/// What to do where a shard is not finished.
std::string run_again(std::size_t shard, const WorkPart& all) {
  return fmt::format("run catena identify --shard {}/{} again", shard + 1, all.of);
}

/// Where a log says that a shard has finished its refits.
Refit end_of(std::size_t shard, const FitResult& fit) {
  return {kEndOfRefits, static_cast<int>(shard), name_of(fit)};
}

Eigen::VectorXd values_of(const RefitsAsked& asked) {
  return Eigen::Vector2d(asked.bootstrap, asked.profiles ? 1 : 0);
}

}  // namespace

std::filesystem::path WorkPart::folder() const {
  return is_shard() ? output / name_of(shard) : output;
}

WorkPart named_shard(const std::string& shard, const std::filesystem::path& output) {
  const std::optional<Shard> found = shard_in(shard, "([0-9]{1,6})/([0-9]{1,6})");
  if (!found)
    throw InputError("--shard: " + in_quotes(shard) +
                     "; give I/N, the number of the shard from 1 and how many there are: 3/8");
  return {*found, found->of, output};
}

WorkPart merge_in(const std::filesystem::path& output) {
  std::map<std::size_t, std::size_t> count;  // of shards, by how many there are to be
  std::error_code error;                     // there are no shards either
  if (std::filesystem::is_directory(output, error))
    for (const auto& entry : std::filesystem::directory_iterator(output))
      if (const auto shard = shard_in(entry.path().filename().string(),
                                      "shard_([1-9][0-9]{0,5})_of_([1-9][0-9]{0,5})"))
        ++count[shard->of];
  if (count.empty())
    throw InputError(output.string() +
                     ": there are no shards; run catena identify with --shard and this --output");
  if (count.size() > 1)
    throw InputError(
        fmt::format("{}: there are shards of {} and of {}; leave those of one number there",
                    output.string(), count.begin()->first, count.rbegin()->first));
  WorkPart all{{0, 0}, count.begin()->first, output};
  for (std::size_t shard = 0; shard < all.of; ++shard)
    if (!std::filesystem::exists(log_of(shard, all)))
      throw InputError(fmt::format("{}: there is no such file; run catena identify --shard {}/{}",
                                   log_of(shard, all).string(), shard + 1, all.of));
  return all;
}

void take_over_others(RunLog& log, const WorkPart& part) {
  for (std::size_t other = 0; other < part.of; ++other) {
    const bool own = part.is_shard() && other == part.shard.part;
    if (!own && std::filesystem::exists(log_of(other, part)))
      log.take_over(log_of(other, part), {other, part.of});
  }
}

InputError start_is_missing(std::size_t start, const WorkPart& part) {
  const std::size_t shard = start % part.of;
  return InputError(fmt::format("{}: start {} is not finished; {}", log_of(shard, part).string(),
                                start + 1, run_again(shard, part)));
}

void note_end(RunLog& log, const WorkPart& part, const FitResult& fit, const RefitsAsked& asked) {
  const Refit end = end_of(part.shard.part, fit);
  if (const auto known = log.refitted(end); !known || *known != values_of(asked))
    log.finish(end, values_of(asked));
}

void require_ends(const RunLog& log, const WorkPart& part, const FitResult& fit,
                  const RefitsAsked& asked) {
  for (std::size_t shard = 0; shard < part.of; ++shard) {
    const std::string file = log_of(shard, part).string();
    const auto done = log.refitted(end_of(shard, fit));
    if (done && *done != values_of(asked))
      throw InputError(
          fmt::format("{}: the shard was run with --bootstrap {}{}; merge with the same", file,
                      (*done)[0], (*done)[1] > 0 ? " --profiles" : ""));
    if (!done && (asked.profiles || asked.bootstrap > 0))
      throw InputError(fmt::format("{}: profiles and bootstrap are not finished; {}", file,
                                   run_again(shard, part)));
  }
}

}  // namespace catena
