#pragma once
// CRC-32C (Castagnoli polynomial 0x1EDC6F41, reflected 0x82F63B78, initial value and final xor 0xFFFFFFFF; RFC 3720,
// appendix B.4: the bytes "123456789" give 0xE3069283). Where the processor multiplies vectors without carries, by
// folding (Gopal et al., Fast CRC computation using PCLMULQDQ, Intel 2009; the last block by the instruction instead of
// Barrett's reduction): about as fast as copying alone. Elsewhere by its instruction for this polynomial, three streams
// at once: it takes three cycles, one can start each cycle, so one stream alone would cost three times as long.
#include <cstddef>
#include <cstdint>

namespace standoff {

/// Whether this processor can do it by folding.
bool processor_folds();

std::uint32_t crc32c(const void* data, std::size_t size, bool fold = processor_folds());

struct Copied {
  std::uint32_t checksum = 0;  // CRC-32C
  bool finite = true;          // of the bytes as doubles, whole ones
};
/// Copies, and finds the rest on the way: the words of an array are loaded once on each end of an exchange.
Copied copy_checked(void* to, const void* from, std::size_t size, bool fold = processor_folds());

/// True if none of the doubles is an infinity or not a number. `data` need not be aligned.
bool all_finite(const void* data, std::size_t count);

}  // namespace standoff
