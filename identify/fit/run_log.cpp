// SPDX-License-Identifier: BSD-3-Clause
//
// Lines, their cells separated by tabulators:
//   catena run log 2 KEY
//   e START ERROR X MESSAGE CHECK                            an evaluation; ERROR may be "failed"
//   s START STATUS ERROR START_ERROR X EVALUATIONS WORK ITERATIONS FAILURES NOISE MESSAGE CHECK   a start
//   r KIND INDEX FIT VALUES CHECK                            a refit
#include "identify/fit/run_log.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "common/in_a_line.hpp"
#include "common/input_error.hpp"
#include "common/number_text.hpp"
#include "common/sha256.hpp"
#include "common/split.hpp"
#include "common/whole_file.hpp"

namespace catena {
namespace {

constexpr char kOurs[] = "catena run log ";
constexpr char kHead[] = "catena run log 2 ";

constexpr std::size_t kCheckLength = 16;  // digits: 64 bits notice any damage

std::string exact(double value) {
  return std::isfinite(value) ? exact_number_text(value) : "failed";
}

std::string exact(const Eigen::VectorXd& x) {
  std::string text;
  for (const double value : x) {
    if (!text.empty()) text += ',';
    text += exact_number_text(value);
  }
  return text;
}

double number(const std::string& text) {
  return text == "failed" ? std::numeric_limits<double>::infinity()
                          : std::strtod(text.c_str(), nullptr);
}

Eigen::VectorXd numbers(const std::string& text) {
  std::vector<double> values;
  if (!text.empty())
    for (const std::string_view cell : split(text, ','))
      values.push_back(number(std::string(cell)));
  return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Of all lines so far, too: none can be changed, removed or put elsewhere without notice.
std::string check_after(const std::string& check, const std::string& content) {
  std::string next = sha256_hex(check + content);
  next.resize(kCheckLength);
  return next;
}

/// A start that did not come to one is begun again.
bool is_an_end(FitStatus status) {
  return status == FitStatus::kConverged || status == FitStatus::kEvaluationLimit ||
         status == FitStatus::kFailed;
}

}  // namespace

std::string name_of(const FitResult& fit) {
  std::string name = sha256_hex(exact(fit.x));
  name.resize(kCheckLength);
  return name;
}

RunLog::RunLog(const std::filesystem::path& file, const std::string& key, Eigen::Index unknowns,
               bool resume, std::function<void(const std::string&)> notice)
    : name_(file.string()), key_(key), unknowns_(unknowns), notice_(std::move(notice)) {
  std::error_code ignored;
  if (std::filesystem::is_symlink(file, ignored))
    throw InputError(name_ +
                     ": is a link, through which no log is written; move it away or choose another "
                     "folder");
  std::filesystem::create_directories(file.parent_path(), ignored);
  const std::string before = std::filesystem::exists(file) ? bytes_of_file(file) : "";
  if (!before.starts_with(kOurs) && !std::string_view(kOurs).starts_with(before))
    throw InputError(name_ + ": is no log of catena; move it away or choose another folder");
  Record known;
  if (resume) known = read(name_, before);
  if (known.whole > 0)
    std::filesystem::resize_file(file, known.whole);  // off with a broken last line
  starts_ = std::move(known.starts);
  refits_ = std::move(known.refits);
  check_ = std::move(known.check);
  file_ = std::fopen(file.c_str(), known.whole > 0 ? "a" : "w");
  if (file_ && known.whole == 0) write(kHead + key + "\n");
  if (!file_ || failed_) throw InputError(name_ + ": cannot be written: " + std::strerror(errno));
}

RunLog::~RunLog() {
  if (file_) std::fclose(file_);
}

void RunLog::take_over(const std::filesystem::path& file, const Shard& shard) {
  const std::string name = file.string();
  Record record = read(name, bytes_of_file(file));
  const auto require = [&](const char* what, int index) {
    if (!shard.has(static_cast<std::size_t>(index)))
      throw InputError(fmt::format(
          "{}: holds {} {}, which is the work of shard {}, not {}, of {}; it was copied or renamed",
          name, what, index + 1, static_cast<std::size_t>(index) % shard.of + 1, shard.part + 1,
          shard.of));
  };
  for (const auto& [start, read] : record.starts) require("start", start);
  for (const auto& [refit, values] : record.refits) require(refit.kind.c_str(), refit.index);
  const std::scoped_lock lock(mutex_);
  for (auto& [start, read] : record.starts)
    if (read.result && !starts_[start].result) starts_[start] = std::move(read);
  refits_.merge(record.refits);
}

/// Whether a run of so many unknowns writes that. Whoever edits a line can give it the right check.
bool RunLog::can_be(const Refit& refit, const Eigen::VectorXd& values) const {
  if (refit.kind == kBootstrapRefit) return values.size() == unknowns_;
  if (refit.kind == kEndOfRefits) return values.size() == 2;
  const auto is_verdict = [](double number) { return number == 0 || number == 1 || number == 2; };
  return refit.kind == kProfileRefit && values.size() >= 3 && values.size() % 2 == 1 &&
         is_verdict(values[0]);
}

RunLog::Record RunLog::read(const std::string& name, const std::string& text) const {
  Record record;
  std::size_t begin = 0;
  int line_number = 1;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos;
       begin = end + 1, ++line_number) {
    const std::string line = text.substr(begin, end - begin);
    if (begin == 0) {
      if (line == kHead + key_) continue;
      throw InputError(name +
                       ": belongs to another case, other data, another model or another version "
                       "of catena; remove it, or run without --resume, to begin anew");
    }
    const std::string content = line.substr(0, line.rfind('\t'));
    record.check = check_after(record.check, content);
    const auto require = [&](bool right) {
      if (!right)
        throw InputError(
            name + ":" + std::to_string(line_number) +
            ": this line was damaged or edited, or one before it was removed; remove it and all "
            "that follow to go on from there, or run without --resume to begin anew");
    };
    require(line == content + "\t" + record.check);
    const std::vector<std::string_view> parts = split(content, '\t');
    const std::vector<std::string> cells(parts.begin(), parts.end());
    if (cells[0] == "e" && cells.size() == 5) {
      Start& start = record.starts[std::atoi(cells[1].c_str())];
      start.by_x.try_emplace(cells[3], start.entries.size());
      start.entries.push_back({number(cells[2]), numbers(cells[3]), cells[4]});
      require(start.entries.back().x.size() == unknowns_);
    } else if (cells[0] == "s" && cells.size() == 12) {
      FitResult result;
      result.status = static_cast<FitStatus>(std::atoi(cells[2].c_str()));
      result.error = number(cells[3]);
      result.start_error = number(cells[4]);
      result.x = numbers(cells[5]);
      result.evaluations = std::atoi(cells[6].c_str());
      result.work = number(cells[7]);
      result.iterations = std::atoi(cells[8].c_str());
      result.failures = std::atoi(cells[9].c_str());
      result.error_noise = number(cells[10]);
      result.message = cells[11];
      require(result.x.size() == unknowns_ && is_an_end(result.status));
      Start& start = record.starts[std::atoi(cells[1].c_str())];
      result.history = start.entries;
      for (const HistoryEntry& entry : start.entries)
        if (!std::isfinite(entry.error)) result.failed.push_back({entry.x, entry.message});
      start.result = std::move(result);
    } else if (cells[0] == "r" && cells.size() == 5) {
      const Refit refit{cells[1], std::atoi(cells[2].c_str()), cells[3]};
      const Eigen::VectorXd& values = record.refits[refit] = numbers(cells[4]);
      require(can_be(refit, values));
    } else {
      require(false);
    }
  }
  record.whole = begin;
  return record;
}

void RunLog::append(const std::string& content) {
  if (failed_) return;
  check_ = check_after(check_, content);
  write(content + "\t" + check_ + "\n");
  if (failed_ && notice_)
    notice_(name_ + ": " + std::strerror(errno) +
            "; the fit goes on, but --resume will know only what came before");
}

void RunLog::write(const std::string& line) {
  failed_ =
      std::fwrite(line.data(), 1, line.size(), file_) != line.size() || std::fflush(file_) != 0;
}

const HistoryEntry* RunLog::recall(int start, const Eigen::VectorXd& x) const {
  const std::scoped_lock lock(mutex_);
  const auto known = starts_.find(start);
  if (known == starts_.end()) return nullptr;
  const auto found = known->second.by_x.find(exact(x));
  return found == known->second.by_x.end() ? nullptr : &known->second.entries[found->second];
}

void RunLog::record(int start, const HistoryEntry& entry) {
  const std::string x = exact(entry.x);
  const std::scoped_lock lock(mutex_);
  Start& own = starts_[start];
  if (own.replayed < own.entries.size() && exact(own.entries[own.replayed].x) == x) {
    ++own.replayed;
    return;
  }
  append("e\t" + std::to_string(start) + "\t" + exact(entry.error) + "\t" + x + "\t" +
         in_a_line(entry.message));
}

std::optional<FitResult> RunLog::finished(int start) const {
  const std::scoped_lock lock(mutex_);
  const auto known = starts_.find(start);
  return known == starts_.end() ? std::nullopt : known->second.result;
}

void RunLog::finish(int start, const FitResult& result) {
  if (!is_an_end(result.status)) return;
  const std::scoped_lock lock(mutex_);
  append("s\t" + std::to_string(start) + "\t" + std::to_string(static_cast<int>(result.status)) +
         "\t" + exact(result.error) + "\t" + exact(result.start_error) + "\t" + exact(result.x) +
         "\t" + std::to_string(result.evaluations) + "\t" + exact_number_text(result.work) + "\t" +
         std::to_string(result.iterations) + "\t" + std::to_string(result.failures) + "\t" +
         exact_number_text(result.error_noise) + "\t" + in_a_line(result.message));
}

std::optional<Eigen::VectorXd> RunLog::refitted(const Refit& refit) const {
  const std::scoped_lock lock(mutex_);
  const auto known = refits_.find(refit);
  return known == refits_.end() ? std::nullopt : std::optional(known->second);
}

void RunLog::finish(const Refit& refit, const Eigen::VectorXd& values) {
  const std::scoped_lock lock(mutex_);
  append(fmt::format("r\t{}\t{}\t{}\t{}", refit.kind, refit.index, refit.fit, exact(values)));
}

}  // namespace catena
