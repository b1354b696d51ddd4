// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/size_pattern.hpp"

#include <cctype>
#include <cstdio>
#include <stdexcept>

namespace catena {

namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool is_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}

// From `from` on, the next integer that is no part of a name or of a number with a point:
// [begin, end); both the length of the text if there is none.
struct Range {
  size_t begin, end;
};

Range next_integer(const std::string& text, size_t from) {
  for (size_t k = from; k < text.size();) {
    size_t end = k;
    while (end < text.size() && is_of_name(text[end])) ++end;
    if (end == k) {
      ++k;
      continue;
    }
    bool digits = true;
    for (size_t d = k; d < end; ++d) digits = digits && is_digit(text[d]);
    if (digits) return {k, end};
    k = end;
  }
  return {text.size(), text.size()};
}

std::string expression(long slope, long constant) {
  const std::string product = slope == 1 ? "links" : std::to_string(slope) + " * links";
  if (constant == 0) return product;
  return product + (constant > 0 ? " + " : " - ") + std::to_string(std::labs(constant));
}

// "i", "i + 1" or "i - 1" before each "]" as a number.
std::string with_index(const std::string& line, long i) {
  std::string out;
  for (size_t k = 0; k < line.size();) {
    const bool alone = line[k] == 'i' && (k == 0 || !is_of_name(line[k - 1]));
    int shift = 0, length = 0;
    char sign = '+';
    if (alone && line.compare(k, 2, "i]") == 0) {
      length = 1;
    } else if (alone && std::sscanf(line.c_str() + k, "i %c %d%n", &sign, &shift, &length) == 2 &&
               line[k + static_cast<size_t>(length)] == ']') {
    } else {
      out += line[k++];
      continue;
    }
    out += std::to_string(sign == '-' ? i - shift : i + shift);
    k += static_cast<size_t>(length);
  }
  return out;
}

}  // namespace

SizePattern::SizePattern(const std::string& at_links, const std::string& at_one_more, int links) {
  const auto differ = [] {
    throw std::logic_error("emitted text differs between numbers of links in more than integers");
  };
  for (size_t here = 0, there = 0;;) {
    const Range a = next_integer(at_links, here), b = next_integer(at_one_more, there);
    const std::string before = at_links.substr(here, a.begin - here);
    if (at_one_more.compare(there, b.begin - there, before) != 0) differ();
    if ((a.begin == at_links.size()) != (b.begin == at_one_more.size())) differ();
    if (a.begin == at_links.size()) {
      end_ = before;
      return;
    }
    const long one = std::stol(at_links.substr(a.begin, a.end - a.begin));
    const long slope = std::stol(at_one_more.substr(b.begin, b.end - b.begin)) - one;
    pieces_.push_back({before, slope, one - slope * links});
    here = a.end;
    there = b.end;
  }
}

std::string SizePattern::at(int links) const {
  std::string out;
  for (const Piece& piece : pieces_) {
    out += piece.before + std::to_string(piece.slope * links + piece.constant);
  }
  return out + end_;
}

std::string SizePattern::text() const {
  std::string out;
  bool argument = false;  // f(links, stands already for f<links>(
  const auto put = [&](std::string literal) {
    if (argument) {
      if (!literal.starts_with(">(")) throw std::logic_error("a type depends on the links");
      literal = literal.substr(2);
    }
    argument = false;
    out += literal;
  };
  for (const Piece& piece : pieces_) {
    put(piece.before);
    if (piece.slope == 0) {
      out += std::to_string(piece.constant);
    } else if (out.back() == '<') {
      out.back() = '(';
      out += expression(piece.slope, piece.constant) + ", ";
      argument = true;
    } else {
      if (out.ends_with("- ") || out.ends_with("* "))
        throw std::logic_error("a number of links under an operator");
      out += expression(piece.slope, piece.constant);
    }
  }
  put(end_);
  return out;
}

std::string written_out(const std::string& statements) {
  std::string out;
  std::vector<std::string> loop;  // its statements
  long first = 0, last = 0;
  int depth = 0;        // of brackets since the loop began
  char compared = ' ';  // i with last: '<' or '>'
  bool in_loop = false;
  for (size_t begin = 0; begin < statements.size();) {
    const size_t end = statements.find('\n', begin);
    std::string line = statements.substr(begin, end - begin);
    line.erase(0, line.find_first_not_of(' '));
    begin = end + 1;
    if (std::sscanf(line.c_str(), "for (int i = %ld; i %c= %ld;", &first, &compared, &last) == 3) {
      if (in_loop) throw std::logic_error("a loop in a loop");
      in_loop = true;
      loop.clear();
    } else if (line == "{") {
      depth += in_loop ? 1 : 0;
    } else if (line == "}" && in_loop && depth == 0) {
      const long step = compared == '<' ? 1 : -1;
      for (long i = first; step > 0 ? i <= last : i >= last; i += step) {
        for (const std::string& one : loop) out += with_index(one, i) + "\n";
      }
      in_loop = false;
    } else if (line == "}") {
      depth -= in_loop ? 1 : 0;
    } else if (in_loop) {
      loop.push_back(line);
    } else {
      out += line + "\n";
    }
  }
  return out;
}

}  // namespace catena
