//! The fingerprint of a vehicle, carried by its trim table so that no other vehicle flies with it.

use sha2::{Digest, Sha256};

use super::Vehicle;

impl Vehicle {
    /// First 8 bytes, little-endian, of SHA-256 over the values in postcard's encoding, in the order of the struct's fields.
    ///
    /// Comments, layout and the order of keys in a file do not matter; every value does.
    #[must_use]
    pub fn hash(&self) -> u64 {
        // Encoding plain data into a vector cannot fail.
        let encoded = postcard::to_extend(self, Vec::new()).unwrap_or_default();
        let digest = Sha256::digest(encoded);
        u64::from_le_bytes(std::array::from_fn(|index| digest[index]))
    }
}
