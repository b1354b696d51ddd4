// SPDX-License-Identifier: BSD-3-Clause
//
// SHA-256 as FIPS 180-4 writes it: names of the standard, section numbers beside the steps.
#include "common/sha256.hpp"

#include <array>
#include <bit>
#include <cstdint>

#include "common/whole_file.hpp"

namespace catena {
namespace {

using std::rotr;
using std::uint32_t;

// 4.2.2: the first 32 bits of the fractional parts of the cube roots of the first 64 primes.
constexpr std::array<uint32_t, 64> K = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

uint32_t Ch(uint32_t x, uint32_t y, uint32_t z) { return (x & y) ^ (~x & z); }
uint32_t Maj(uint32_t x, uint32_t y, uint32_t z) { return (x & y) ^ (x & z) ^ (y & z); }
uint32_t Sigma0(uint32_t x) { return rotr(x, 2) ^ rotr(x, 13) ^ rotr(x, 22); }
uint32_t Sigma1(uint32_t x) { return rotr(x, 6) ^ rotr(x, 11) ^ rotr(x, 25); }
uint32_t sigma0(uint32_t x) { return rotr(x, 7) ^ rotr(x, 18) ^ (x >> 3); }
uint32_t sigma1(uint32_t x) { return rotr(x, 17) ^ rotr(x, 19) ^ (x >> 10); }

/// The hash of a message that comes in parts of any size: a file need not be in memory.
class Sha256 {
 public:
  void add(std::string_view part) {
    size_ += part.size();
    rest_ += part;
    std::size_t at = 0;
    for (; at + 64 <= rest_.size(); at += 64) add_block(std::string_view(rest_).substr(at, 64));
    rest_.erase(0, at);
  }

  /// 5.1.1: a one bit, zeros up to 56 bytes modulo 64, the length in bits. Nothing can be added then.
  std::string hexadecimal() {
    const std::uint64_t bits = 8 * size_;
    std::string end(1, '\x80');
    end.resize(1 + (119 - rest_.size()) % 64, '\0');
    for (int shift = 56; shift >= 0; shift -= 8)
      end.push_back(static_cast<char>((bits >> shift) & 0xff));
    add(end);
    std::string digest;
    for (const uint32_t word : hash_) {
      for (int shift = 28; shift >= 0; shift -= 4)
        digest += "0123456789abcdef"[(word >> shift) & 0xf];
    }
    return digest;
  }

 private:
  void add_block(std::string_view block) {  // 6.2.2
    std::array<uint32_t, 64> W{};
    for (std::size_t t = 0; t < 64; ++t) {
      if (t < 16) {
        for (std::size_t byte = 0; byte < 4; ++byte) {
          W[t] = (W[t] << 8) | static_cast<unsigned char>(block[4 * t + byte]);
        }
      } else {
        W[t] = sigma1(W[t - 2]) + W[t - 7] + sigma0(W[t - 15]) + W[t - 16];
      }
    }
    auto [a, b, c, d, e, f, g, h] = hash_;
    for (std::size_t t = 0; t < 64; ++t) {
      const uint32_t T1 = h + Sigma1(e) + Ch(e, f, g) + K[t] + W[t];
      const uint32_t T2 = Sigma0(a) + Maj(a, b, c);
      h = g, g = f, f = e, e = d + T1;
      d = c, c = b, b = a, a = T1 + T2;
    }
    const std::array<uint32_t, 8> working = {a, b, c, d, e, f, g, h};
    for (std::size_t i = 0; i < 8; ++i) hash_[i] += working[i];
  }

  // 5.3.3: H of the standard, the same as K of the square roots of the first eight primes.
  std::array<uint32_t, 8> hash_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                   0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::uint64_t size_ = 0;
  std::string rest_;  // less than a block
};

}  // namespace

std::string sha256_hex(std::string_view message) {
  Sha256 hash;
  hash.add(message);
  return hash.hexadecimal();
}

std::string sha256_of_file(const std::filesystem::path& file) {
  Sha256 hash;
  read_in_parts(file, [&](std::string_view part) { hash.add(part); });
  return hash.hexadecimal();
}

}  // namespace catena
