// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/context.hpp"

#include <algorithm>
#include <limits>

#include "common/sha256.hpp"
#include "common/whole_file.hpp"

namespace catena {

namespace fs = std::filesystem;

namespace {

Description model_to_diagnose(const Case& the_case) {
  return the_case.description.empty() ? plain_chain() : read_description(the_case.description);
}

}  // namespace

DiagnosisContext::DiagnosisContext(const Case& the_case, const std::vector<fs::path>& effect_files,
                                   fs::path folder, LeastSquares solver,
                                   ProviderOptions provider_options)
    : least_squares(std::move(solver)),
      provider(std::move(provider_options)),
      asked_simulation(the_case.simulation),
      original_(model_to_diagnose(the_case)),
      folder_(std::move(folder)),
      library_(library_of_candidates(effect_files, original_, the_case)) {}

const Candidate* DiagnosisContext::find(const std::string& id) const {
  const auto found = std::find_if(library_.begin(), library_.end(),
                                  [&](const Candidate& candidate) { return candidate.id == id; });
  return found == library_.end() ? nullptr : &*found;
}

bool DiagnosisContext::knows(const std::string& id) const {
  return find(id) || std::any_of(original_.effects.begin(), original_.effects.end(),
                                 [&](const Effect& effect) { return effect.id == id; });
}

Candidate& DiagnosisContext::add_effect(const std::string& id, const std::string& text) {
  const fs::path file = folder_ / (id + ".toml");
  write_whole_file(file, text);
  library_.push_back(candidate_of(read_effect(file)));
  library_.back().own_model = true;
  return library_.back();
}

std::vector<std::string> DiagnosisContext::in_model(const std::vector<std::string>& effects) const {
  std::vector<std::string> left = effects;
  std::erase_if(left, [&](const std::string& effect) { return find(effect)->of_case; });
  return left;
}

Description DiagnosisContext::description_with(const std::vector<std::string>& effects, int links,
                                               const std::string& id) const {
  Description description = original_;
  for (const std::string& effect : in_model(effects))
    description.effects.push_back(find(effect)->effect);
  description.id = id;
  description.links = {links};
  return description;
}

Model DiagnosisContext::once(const std::string& key, const std::function<Model()>& make) {
  std::promise<Model> promise;
  std::shared_future<Model> model;
  bool mine = false;
  {
    const std::lock_guard lock(models_mutex_);
    const auto [place, added] = models_.try_emplace(key);
    if (added) place->second = promise.get_future().share();
    model = place->second;
    mine = added;
  }
  if (mine) {
    try {
      promise.set_value(make());
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  }
  return model.get();
}

Model DiagnosisContext::made_with(const std::vector<std::string>& effects, int links,
                                  bool for_fits) {
  std::string key = (for_fits ? "fits " : "all ") + std::to_string(links);
  for (const std::string& effect : effects) key += " " + effect;
  return once(key, [&] {
    std::string id = original_.id;
    for (const std::string& effect : effects) id += "_" + effect;
    if (effects.size() > 4)
      id = original_.id + "_and_" + std::to_string(effects.size()) + "_effects";
    const fs::path file = folder_ / (sha256_hex(key) + ".toml");
    write_description(description_with(effects, links, id), file);
    ProviderOptions options = provider;
    options.for_fits = for_fits;
    return provide_model(file, links, options);
  });
}

Model DiagnosisContext::model_with(const std::vector<std::string>& all, int links) {
  const std::vector<std::string> effects = in_model(all);
  std::vector<std::string> own;
  for (const std::string& effect : effects)
    if (find(effect)->own_model) own.push_back(effect);
  const bool alone = effects.empty() || (effects.size() == 1 && !own.empty());
  return alone ? made_with(effects, links, true) : model_with_all(links, own);
}

Model DiagnosisContext::complete_model_with(const std::vector<std::string>& effects, int links) {
  return made_with(in_model(effects), links, false);
}

Model DiagnosisContext::model_with_all(int links, const std::vector<std::string>& needed) {
  std::vector<std::string> effects;
  for (const Candidate& candidate : library_) {
    const bool wanted = std::find(needed.begin(), needed.end(), candidate.id) != needed.end();
    if (wanted || (candidate.unavailable.empty() && !candidate.own_model && !candidate.of_case))
      effects.push_back(candidate.id);
  }
  return made_with(effects, links, true);
}

void DiagnosisContext::begin(const std::string& doing, std::size_t count) {
  const std::lock_guard lock(progress_mutex_);
  progress_.doing = doing;
  progress_.done = 0;
  progress_.of = static_cast<int>(count);
  begin_ = std::chrono::steady_clock::now();
  tell();
}

void DiagnosisContext::begin_task(const std::string& doing) {
  const std::lock_guard lock(progress_mutex_);
  progress_.doing = doing;
  tell();
}

void DiagnosisContext::end_task() {
  const std::lock_guard lock(progress_mutex_);
  ++progress_.done;
  tell();
}

void DiagnosisContext::tell_best(const std::string& words) {
  const std::lock_guard lock(progress_mutex_);
  progress_.best = words;
}

std::string DiagnosisContext::best() const {
  const std::lock_guard lock(progress_mutex_);
  return progress_.best;
}

void DiagnosisContext::tell() {
  if (!notice) return;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  progress_.seconds_left = progress_.done > 0
                               ? seconds / progress_.done * (progress_.of - progress_.done)
                               : std::numeric_limits<double>::quiet_NaN();
  notice(progress_);
}

}  // namespace catena
