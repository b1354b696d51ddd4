// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/attribution.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "generator/checking/expression_text.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

/// The source of terms: the symbol in which they are linear, and whether they are weights.
using Source = std::pair<SymbolOrder, bool>;

struct Piece {
  ex scale = 0;
  GiNaC::exvector terms;
};

struct ModelPart {
  std::string origin;
  ex numerator = 0;
};

class Attribution {
 public:
  Attribution(const ChainSymbols& chain, NormalForm& form) : chain_(chain), form_(form) {
    for (std::size_t i = 1; i < chain.mass.size(); ++i) {
      add_scale(chain.mass[i]);
      add_scale(chain.inertia[i]);
      add_scale(chain.stiffness[i]);
      add_scale(chain.damping[i]);
    }
    for (std::size_t i = 1; i < chain.torque.size(); ++i) add_scale(chain.torque[i]);
    add_scale(chain.load_mass);
    for (const auto& [name, symbols] : chain.effects)
      for (const ex& symbol : symbols)
        if (!symbol.is_zero()) add_scale(symbol);
  }

  std::vector<std::string> run(const Fraction& difference, const Contributions& parts) {
    const std::map<Source, ModelPart> model = model_parts(parts);
    if (const std::optional<std::string> whole = whole_entry(difference, parts)) return {*whole};
    std::map<Source, Piece> pieces;
    GiNaC::exvector homeless;
    for_each_term(difference.numerator, [&](const ex& term) {
      const std::optional<Source> source = source_of(term);
      if (source) {
        pieces[*source].terms.push_back(term);
      } else {
        homeless.push_back(term);
      }
    });
    std::vector<std::string> result;
    for (const auto& [source, piece] : pieces) {
      const Fraction value{GiNaC::add(piece.terms), difference.denominator};
      const auto part = model.find(source);
      std::string sentence =
          part == model.end() ? stray(source, value) : compared(part->second, value);
      // The parameters of one effect may all be missing.
      if (std::find(result.begin(), result.end(), sentence) == result.end())
        result.push_back(std::move(sentence));
    }
    if (!homeless.empty())
      result.push_back(
          "terms linear in no single mass, inertia, stiffness, damping, torque or parameter of an "
          "effect: " +
          text_of({GiNaC::add(homeless), difference.denominator}, form_));
    return result;
  }

 private:
  void add_scale(const ex& symbol) {
    std::ostringstream name;
    name << symbol;
    scales_.emplace(symbol, SymbolOrder(name.str()));
  }

  template <class Action>
  static void for_each_term(const ex& polynomial, const Action& action) {
    if (GiNaC::is_a<GiNaC::add>(polynomial)) {
      for (const ex& term : polynomial) action(term);
    } else if (!polynomial.is_zero()) {
      action(polynomial);
    }
  }

  std::optional<Source> source_of(const ex& term) const {
    std::optional<Source> result;
    bool several = false;
    const auto look_at = [&](const ex& factor) {
      const bool power = GiNaC::is_a<GiNaC::power>(factor);
      const auto scale = scales_.find(power ? factor.op(0) : factor);
      if (scale == scales_.end()) return;
      several = several || power || result;
      result = Source{scale->second, term.has(chain_.gravity)};
    };
    if (GiNaC::is_a<GiNaC::mul>(term)) {
      for (const ex& factor : term) look_at(factor);
    } else {
      look_at(term);
    }
    return several ? std::nullopt : result;
  }

  std::map<Source, ModelPart> model_parts(const Contributions& parts) {
    std::map<Source, ModelPart> result;
    for (const Contribution& part : parts) {
      const Fraction value = form_(part.value);
      if (value.numerator.is_zero() || value.denominator != 1) continue;
      std::map<Source, GiNaC::exvector> terms;  // an effect may have several parameters
      for_each_term(value.numerator, [&](const ex& term) {
        if (const std::optional<Source> source = source_of(term)) terms[*source].push_back(term);
      });
      for (const auto& [source, own] : terms) {
        ModelPart& entry = result[source];
        if (entry.origin.find(part.origin) == std::string::npos)
          entry.origin += (entry.origin.empty() ? "" : " and ") + part.origin;
        entry.numerator = (entry.numerator + GiNaC::add(own)).expand();
      }
    }
    return result;
  }

  /// A sentence if the whole entry is the model's times a factor.
  std::optional<std::string> whole_entry(const Fraction& difference, const Contributions& parts) {
    const Fraction model = form_(total(parts));
    if (parts.size() < 2 || model.denominator != 1 || difference.denominator != 1)
      return std::nullopt;
    const std::optional<numeric> excess = ratio(difference.numerator, model.numerator);
    if (!excess) return std::nullopt;
    const numeric factor = *excess + 1;
    if (factor == 0) return std::nullopt;  // all parts are missing, each is named
    return factor == -1 ? "the whole entry has the wrong sign"
                        : "the whole entry is multiplied by " + text_of(factor);
  }

  /// The number r with piece = r * part, if there is one.
  static std::optional<numeric> ratio(const ex& piece, const ex& part) {
    const ex first = GiNaC::is_a<GiNaC::add>(part) ? part.op(0) : part;
    std::optional<numeric> result;
    for_each_term(piece, [&](const ex& term) {
      const ex quotient = term / first;
      if (GiNaC::is_a<numeric>(quotient)) result = GiNaC::ex_to<numeric>(quotient);
    });
    if (!result || !(piece - *result * part).expand().is_zero()) return std::nullopt;
    return result;
  }

  std::string compared(const ModelPart& part, const Fraction& piece) const {
    if (piece.denominator == 1) {
      if (const std::optional<numeric> excess = ratio(piece.numerator, part.numerator)) {
        const numeric factor = *excess + 1;
        if (factor == 0) return part.origin + ": missing";
        if (factor == -1) return part.origin + ": has the wrong sign";
        return part.origin + ": multiplied by " + text_of(factor);
      }
    }
    return part.origin + ": off by " + text_of(piece, form_);
  }

  std::string stray(const Source& source, const Fraction& piece) const {
    return source.first.name + " does not belong here" + (source.second ? " together with g" : "") +
           ": " + text_of(piece, form_);
  }

  const ChainSymbols& chain_;
  NormalForm& form_;
  std::map<ex, SymbolOrder, GiNaC::ex_is_less> scales_;
};

}  // namespace

std::vector<std::string> origins_of(const Fraction& difference, const Contributions& parts,
                                    const ChainSymbols& chain, NormalForm& form) {
  return Attribution(chain, form).run(difference, parts);
}

}  // namespace catena::checking
