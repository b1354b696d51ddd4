// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/sweeps.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace catena {
namespace {

class Schedule {
 public:
  Schedule(Families& families, Layout layout) : families_(families), layout_(layout) {}

  std::vector<Sweep> schedule() {
    for (;;) {
      bool open = false, alone = false;
      for (size_t k = 0; k < families_.all.size(); ++k) {
        if (families_.all[k].sweep >= 0) continue;
        open = true;
        if (families_.all[k].items.count(kNoIndex) && ready(families_.all[k])) {
          add_sweep(0, {k});
          alone = true;
        }
      }
      if (!open) break;
      if (alone) continue;
      std::vector<size_t> forward, backward;
      for (const std::set<int>& guard : open_guards()) {
        forward = sweep_in(1, guard);
        backward = sweep_in(-1, guard);
        if (!forward.empty() || !backward.empty()) break;
      }
      if (forward.empty() && backward.empty()) {
        for (const std::set<int>& guard : open_guards()) {
          forward = joint_sweep_in(1, guard);
          backward = joint_sweep_in(-1, guard);
          if (!forward.empty() || !backward.empty()) break;
        }
      }
      if (forward.empty() && backward.empty()) throw std::logic_error("no order of statements");
      const int direction = forward.size() >= backward.size() ? 1 : -1;
      const auto& members = direction > 0 ? forward : backward;
      if (layout_ == Layout::kWholeSweeps) {
        add_sweep(direction, members);
      } else {
        add_sweeps(direction, members);
      }
    }
    for (const Family& family : families_.all) {
      for (const Dependency& d : family.dependencies) {
        Family& read = families_.named(d.family);
        if (d.offset != 0 || read.sweep != family.sweep) read.local = false;
      }
    }
    if (layout_ == Layout::kWholeSweeps) {
      carry();
    } else {
      for (const Family& family : families_.all) keep(family);
    }
    return std::move(sweeps_);
  }

 private:
  bool done(const std::string& family) const { return families_.named(family).sweep >= 0; }

  bool ready(const Family& family) const {
    return std::all_of(family.dependencies.begin(), family.dependencies.end(),
                       [&](const Dependency& d) { return done(d.family); });
  }

  std::vector<size_t> sweep_in(int direction, const std::set<int>& guard) const {
    std::vector<size_t> included;
    std::set<std::string> names;
    for (bool grown = true; grown;) {
      grown = false;
      for (size_t k = 0; k < families_.all.size(); ++k) {
        const Family& family = families_.all[k];
        if (family.sweep >= 0 || names.count(family.name) || family.items.count(kNoIndex) ||
            family.guard != guard)
          continue;
        const bool fits = std::all_of(
            family.dependencies.begin(), family.dependencies.end(), [&](const Dependency& d) {
              if (done(d.family)) return true;
              if (d.offset == kUnrelated) return false;
              const bool before = d.offset * direction < 0;
              if (d.family == family.name) return before;
              return names.count(d.family) > 0 && (before || d.offset == 0);
            });
        if (!fits) continue;
        included.push_back(k);
        names.insert(family.name);
        grown = true;
      }
    }
    return included;
  }

  // Families that need one another at the link before, such as the components of a vector that is turned from link to
  // link: all that need nothing else, in an order in which each comes after what it needs at its own link.
  std::vector<size_t> joint_sweep_in(int direction, const std::set<int>& guard) const {
    std::set<size_t> members;
    for (size_t k = 0; k < families_.all.size(); ++k) {
      const Family& family = families_.all[k];
      if (family.sweep < 0 && !family.items.count(kNoIndex) && family.guard == guard)
        members.insert(k);
    }
    const auto fits = [&](size_t k) {
      const auto& dependencies = families_.all[k].dependencies;
      return std::all_of(dependencies.begin(), dependencies.end(), [&](const Dependency& d) {
        if (done(d.family)) return true;
        return d.offset != kUnrelated && d.offset * direction <= 0 &&
               members.contains(families_.position(d.family));
      });
    };
    while (std::erase_if(members, [&](size_t k) { return !fits(k); }) > 0) {
    }
    std::vector<size_t> ordered;
    const auto comes_next = [&](size_t k) {
      const auto& dependencies = families_.all[k].dependencies;
      return std::all_of(dependencies.begin(), dependencies.end(), [&](const Dependency& d) {
        return d.offset != 0 || done(d.family) ||
               std::find(ordered.begin(), ordered.end(), families_.position(d.family)) !=
                   ordered.end();
      });
    };
    for (bool grown = true; grown;) {
      grown = false;
      for (const size_t k : members) {
        if (std::find(ordered.begin(), ordered.end(), k) != ordered.end() || !comes_next(k))
          continue;
        ordered.push_back(k);
        grown = true;
      }
    }
    return ordered.size() == members.size() ? ordered : std::vector<size_t>();
  }

  void add_sweep(int direction, std::vector<size_t> members) {
    for (const size_t k : members) families_.all[k].sweep = static_cast<int>(sweeps_.size());
    sweeps_.push_back({direction, std::move(members)});
  }

  // A sweep as up to three: what needs no neighbour's result, what does, and what follows from
  // that. Only the middle one has to go link by link; of the others, upwards in memory, the
  // compiler makes vectors.
  void add_sweeps(int direction, const std::vector<size_t>& members) {
    std::map<size_t, std::set<size_t>> needs;  // within the sweep, directly or not
    for (const size_t k : members) {
      std::vector<size_t> open{k};
      while (!open.empty()) {
        const Family& family = families_.all[open.back()];
        open.pop_back();
        for (const Dependency& d : family.dependencies) {
          const size_t read = families_.position(d.family);
          if (families_.all[read].sweep < 0 && needs[k].insert(read).second) open.push_back(read);
        }
      }
    }
    std::set<size_t> chained;  // needs itself, of the link before
    for (const size_t k : members) {
      if (needs[k].count(k)) chained.insert(k);
    }
    std::vector<size_t> before, between, after;
    for (const size_t k : members) {
      const auto leads_to = [&](size_t other) { return needs[other].count(k) > 0; };
      const auto comes_of = [&](size_t other) { return needs[k].count(other) > 0; };
      if (std::none_of(chained.begin(), chained.end(), comes_of)) {
        before.push_back(k);
      } else if (std::any_of(chained.begin(), chained.end(), leads_to)) {
        between.push_back(k);
      } else {
        after.push_back(k);
      }
    }
    add_layers(before);
    if (!between.empty()) add_sweep(direction, between);
    add_layers(after);
  }

  // Families of which none needs itself: who reads a neighbour of another follows in a sweep of its own. In
  // the same sweep it would read, as part of a vector, what has just been written as part of two.
  void add_layers(const std::vector<size_t>& members) {
    std::vector<std::vector<size_t>> layers;
    std::map<size_t, size_t> layer_of;
    for (const size_t k : members) {
      size_t layer = 0;
      for (const Dependency& d : families_.all[k].dependencies) {
        const auto read = layer_of.find(families_.position(d.family));
        if (read != layer_of.end()) layer = std::max(layer, read->second + (d.offset == 0 ? 0 : 1));
      }
      layer_of[k] = layer;
      layers.resize(std::max(layers.size(), layer + 1));
      layers[layer].push_back(k);
    }
    for (const std::vector<size_t>& layer : layers) {
      const std::vector<size_t> alone = of_the_last(layer);
      std::vector<size_t> others;
      for (const size_t k : layer)
        if (std::find(alone.begin(), alone.end(), k) == alone.end()) others.push_back(k);
      if (!others.empty()) add_sweep(1, others);
      if (!alone.empty()) add_sweep(1, alone);
    }
  }

  // Families of a layer that only its last link has, which would cut it off the loop over all links: they may
  // follow, where no other of the layer reads them, and they read none that needs no array else.
  std::vector<size_t> of_the_last(const std::vector<size_t>& layer) const {
    int last = kNoIndex;
    for (const size_t k : layer) last = std::max(last, families_.all[k].items.rbegin()->first);
    std::set<size_t> alone;
    for (const size_t k : layer) {
      const auto& items = families_.all[k].items;
      if (items.size() == 1 && items.begin()->first == last) alone.insert(k);
    }
    const std::set<size_t> members(layer.begin(), layer.end());
    const auto is_stored = [&](size_t k) {
      return std::any_of(families_.all.begin(), families_.all.end(), [&](const Family& reader) {
        return !members.contains(families_.position(reader.name)) && reads(reader, k);
      });
    };
    for (bool fewer = true; fewer;) {
      fewer = false;
      for (const size_t k : layer) {
        if (!alone.contains(k)) continue;
        const bool stays = std::any_of(layer.begin(), layer.end(), [&](size_t other) {
          if (alone.contains(other)) return false;
          return reads(families_.all[other], k) ||
                 (reads(families_.all[k], other) && !is_stored(other));
        });
        if (stays) fewer = alone.erase(k) > 0;
      }
    }
    return alone.size() == layer.size() ? std::vector<size_t>()
                                        : std::vector<size_t>(alone.begin(), alone.end());
  }

  bool reads(const Family& family, size_t k) const {
    return std::any_of(family.dependencies.begin(), family.dependencies.end(),
                       [&](const Dependency& d) { return families_.position(d.family) == k; });
  }

  // Of the families that have no sweep yet; what is always computed first.
  std::set<std::set<int>> open_guards() const {
    std::set<std::set<int>> guards;
    for (const Family& family : families_.all)
      if (family.sweep < 0) guards.insert(family.guard);
    return guards;
  }

  // What is read at the same link and the one before, and after the sweep at its last link, needs
  // no array: `name` and `name_last` do.
  void carry() {
    std::set<size_t> stored;
    for (const Family& reader : families_.all) {
      for (const auto& [index, item] : reader.items) {
        for (const int number : families_.definitions().symbols_of(item.value)) {
          const Symbol& symbol = families_.definitions()[number];
          if (families_.given(symbol)) continue;
          const size_t k = families_.position(symbol.family);
          const Family& family = families_.all[k];
          const int direction = sweeps_[static_cast<size_t>(family.sweep)].direction;
          const int last =
              direction > 0 ? family.items.rbegin()->first : family.items.begin()->first;
          const bool near = reader.sweep == family.sweep
                                ? symbol.index == index || symbol.index == index - direction
                                : symbol.index == last;
          if (direction == 0 || !near) stored.insert(k);
        }
      }
    }
    for (size_t k = 0; k < families_.all.size(); ++k)
      families_.all[k].carried =
          !families_.all[k].is_output && !families_.all[k].local && !stored.count(k);
  }

  // Where an array of a matrix gets what another family stores, that family needs no array.
  void keep(const Family& output) {
    if (!output.is_output || !output.guard.empty() || !output.adds_to.empty()) return;
    const Output& first = *output.items.begin()->second.output;
    const GiNaC::ex& value = first.value;
    if (first.array.owner != "matrix" || !first.place || !first.place->of_link ||
        !GiNaC::is_a<GiNaC::symbol>(value))
      return;
    const Symbol& symbol = families_.definitions()[families_.definitions().number_of(value)];
    if (families_.given(symbol)) return;
    Family& family = families_.named(symbol.family);
    if (family.local || family.kept != nullptr || family.along != output.along ||
        family.sweep != output.sweep || family.items.size() != output.items.size() ||
        !family.guard.empty())
      return;
    for (const auto& [link, item] : output.items) {
      const auto of_family = family.items.find(link);
      if (of_family == family.items.end() || item.output->place != first.place ||
          !item.value.is_equal(families_.definitions()[of_family->second.number].symbol))
        return;
    }
    for (const Family& other : families_.all) {
      if (other.adds_to == family.name || other.adds_to == output.name) return;
      for (const Dependency& d : other.dependencies)
        if (other.sweep == family.sweep && d.family == family.name && d.offset != 0) return;
    }
    family.kept = &first;
  }

  Families& families_;
  Layout layout_;
  std::vector<Sweep> sweeps_;
};

}  // namespace

std::vector<Sweep> schedule(Families& families, Layout layout) {
  return Schedule(families, layout).schedule();
}

}  // namespace catena
