//! Seeded randomness: the only source of chance. The same seed gives the same stream on every machine.

use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

/// Where a stream of random numbers begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Seed(pub u64);

impl Seed {
    /// The stream of this seed.
    #[must_use]
    pub fn stream(self) -> Xoshiro256PlusPlus {
        Xoshiro256PlusPlus::seed_from_u64(self.0)
    }

    /// The seed of the `index`-th independent part of the work, so that parts may run in any order or at once.
    #[must_use]
    pub fn part(self, index: u64) -> Self {
        // SplitMix64 (Steele, Lea, Flood 2014): neighbouring indices give unrelated seeds.
        let mut z = self.0.wrapping_add(index.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        Self(z ^ (z >> 31))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::Rng;

    #[test]
    fn equal_seeds_give_equal_streams_and_parts_differ() {
        let draw = |seed: Seed| seed.stream().next_u64();
        assert_eq!(draw(Seed(7)), draw(Seed(7)));
        let parts: std::collections::HashSet<u64> = (0..1000).map(|i| draw(Seed(7).part(i))).collect();
        assert_eq!(parts.len(), 1000);
    }
}
