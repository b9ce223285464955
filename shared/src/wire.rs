//! Frames between a host and the firmware.
//!
//! ```text
//! COBS( schema: u32 LE | postcard(Header) | postcard(Message) | CRC-32: u32 LE ) 0x00
//! ```
//!
//! The schema is a hash of the message types: two sides that were built from different types never misread each other.
//! A frame that is damaged, too long, of another schema, unknown, or followed by left-over bytes is counted and dropped.
//!
//! The firmware speaks first, with [`Hello`]. The host may then [`Message::Configure`] it, and from there every
//! [`Message::Sensors`] is answered by one [`Message::Actuators`], whatever the speed.

use heapless::String;
use postcard_schema::{Schema, key::Key};
use serde::{Deserialize, Serialize};

use crate::checksum::crc32;
use crate::commands::Commands;
use crate::device::Measurements;
use crate::mission::Mission;
use crate::parameters::Parameters;

/// Version of the exchange itself: which message may follow which.
pub const PROTOCOL: u16 = 1;
/// Bytes of the longest frame, its COBS overhead and delimiter included.
pub const MAX_FRAME: usize = 512;
/// Ends every frame, and stands nowhere in one.
pub const DELIMITER: u8 = 0;

const SCHEMA_BYTES: usize = 4;
const CRC_BYTES: usize = 4;

/// What every frame starts with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
pub struct Header {
    /// Counts the frames of one sender.
    pub sequence: u32,
    /// Proof of who sent it.
    pub auth: Auth,
}

/// Proof of the sender (append only). Commands to a vehicle at sea will need one; the bench does not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
pub enum Auth {
    /// None given.
    None,
}

/// Everything that is said on the link (append only).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
#[allow(clippy::large_enum_variant, reason = "no allocator to box the configuration in")]
pub enum Message {
    /// Firmware, first of all: who is speaking.
    Hello(Hello),
    /// Host: fly this.
    Configure(Configuration),
    /// Firmware: the configuration is accepted, send sensor frames.
    Ready,
    /// Firmware: the last message was understood and is refused.
    Refused(Refusal),
    /// Host: one tick of measurements (simulation mode only).
    Sensors(SensorFrame),
    /// Firmware: the answer to one sensor frame.
    Actuators(ActuatorFrame),
}

/// Who is speaking.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
pub struct Hello {
    /// [`PROTOCOL`] of the firmware.
    pub protocol: u16,
    /// Fingerprint of the vehicle whose table the image carries.
    pub vehicle_hash: u64,
    /// Board that the image was built for.
    pub board: String<16>,
    /// Build of the image.
    pub build: String<32>,
    /// Whether the bench jumper allows simulated measurements.
    pub simulation: bool,
}

/// What to fly, and how.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
pub struct Configuration {
    /// The mission.
    pub mission: Mission,
    /// Tuning of the controller.
    pub parameters: Parameters,
}

/// Why a message was refused (append only).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Refusal {
    /// A value of the mission or the parameters is outside its range.
    InvalidConfiguration,
    /// Measurements may only be simulated with the bench jumper fitted.
    NotSimulating,
    /// Sensor frames came before a configuration, or out of order.
    OutOfOrder,
    /// A message that only the firmware sends.
    NotForFirmware,
}

/// One tick of measurements.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
pub struct SensorFrame {
    /// Ticks since the mission began.
    pub tick: u32,
    /// What the devices say.
    pub measurements: Measurements,
}

/// The answer to one sensor frame.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
pub struct ActuatorFrame {
    /// The tick that is answered.
    pub tick: u32,
    /// What the devices shall do.
    pub commands: Commands,
    /// Counts of the core clock that the step took.
    pub step_clocks: u32,
}

/// Hash of all that crosses the link; another value means another build of the types.
#[must_use]
pub const fn schema() -> u32 {
    const KEY: [u8; 8] = Key::for_path::<(Header, Message)>("glider").to_bytes();
    let [a, b, c, d, ..] = KEY;
    u32::from_le_bytes([a, b, c, d])
}

/// Why a message could not be framed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLong;

/// Writes one frame, delimiter included, and returns it.
///
/// # Errors
/// [`TooLong`] if the frame does not fit [`MAX_FRAME`].
pub fn encode<'a>(header: &Header, message: &Message, frame: &'a mut [u8; MAX_FRAME]) -> Result<&'a [u8], TooLong> {
    let mut plain = [0_u8; MAX_FRAME];
    let used = write_plain(header, message, &mut plain).ok_or(TooLong)?;
    let plain = plain.get(..used).ok_or(TooLong)?;
    if cobs::max_encoding_length(plain.len()) >= MAX_FRAME {
        return Err(TooLong);
    }
    let encoded = cobs::try_encode(plain, frame.as_mut_slice()).map_err(|_| TooLong)?;
    *frame.get_mut(encoded).ok_or(TooLong)? = DELIMITER;
    frame.get(..=encoded).ok_or(TooLong)
}

/// Schema, header, message and CRC; the number of bytes.
fn write_plain(header: &Header, message: &Message, plain: &mut [u8; MAX_FRAME]) -> Option<usize> {
    plain.get_mut(..SCHEMA_BYTES)?.copy_from_slice(&schema().to_le_bytes());
    let body = plain.get_mut(SCHEMA_BYTES..)?;
    let body_bytes = postcard::to_slice(&(header, message), body).ok()?.len();
    let end = SCHEMA_BYTES.checked_add(body_bytes)?;
    let crc = crc32(plain.get(..end)?);
    let total = end.checked_add(CRC_BYTES)?;
    plain.get_mut(end..total)?.copy_from_slice(&crc.to_le_bytes());
    Some(total)
}

/// Why bytes were dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Damage {
    /// No delimiter within [`MAX_FRAME`] bytes.
    Overlong,
    /// The frame's bytes do not add up to its CRC.
    Corrupt,
    /// A whole frame from a side that was built from other types.
    OtherSchema(u32),
    /// A whole frame whose content is not a message, or has bytes left over.
    Unknown,
}

/// Collects bytes into frames.
#[derive(Clone, Debug)]
pub struct Decoder {
    buffer: [u8; MAX_FRAME],
    used: usize,
    overlong: bool,
    /// Frames that were dropped.
    pub dropped: u32,
}

impl Default for Decoder {
    fn default() -> Self {
        Self { buffer: [0; MAX_FRAME], used: 0, overlong: false, dropped: 0 }
    }
}

impl Decoder {
    /// Takes one byte; gives a message, or the reason for dropping one, when a frame ends.
    pub fn push(&mut self, byte: u8) -> Option<Result<(Header, Message), Damage>> {
        if byte != DELIMITER {
            match self.buffer.get_mut(self.used) {
                Some(slot) => {
                    *slot = byte;
                    self.used = self.used.saturating_add(1);
                }
                None => self.overlong = true,
            }
            return None;
        }
        let (used, overlong) = (self.used, self.overlong);
        self.used = 0;
        self.overlong = false;
        if used == 0 {
            return None; // Delimiters between frames are harmless.
        }
        let result = if overlong { Err(Damage::Overlong) } else { self.read_frame(used) };
        if result.is_err() {
            self.dropped = self.dropped.saturating_add(1);
        }
        Some(result)
    }

    fn read_frame(&mut self, used: usize) -> Result<(Header, Message), Damage> {
        let frame = self.buffer.get(..used).ok_or(Damage::Corrupt)?;
        // Not in place: that decoder indexes, and leaves a panic in the image that nobody can reach.
        let mut plain = [0; MAX_FRAME];
        let plain_bytes = cobs::decode(frame, &mut plain).map_err(|_| Damage::Corrupt)?;
        let plain = plain.get(..plain_bytes).ok_or(Damage::Corrupt)?;
        let (content, crc) = plain.split_last_chunk::<CRC_BYTES>().ok_or(Damage::Corrupt)?;
        if crc32(content) != u32::from_le_bytes(*crc) {
            return Err(Damage::Corrupt);
        }
        let (their_schema, body) = content.split_first_chunk::<SCHEMA_BYTES>().ok_or(Damage::Corrupt)?;
        let their_schema = u32::from_le_bytes(*their_schema);
        if their_schema != schema() {
            return Err(Damage::OtherSchema(their_schema));
        }
        match postcard::take_from_bytes(body) {
            Ok((content, [])) => Ok(content),
            Ok(_) | Err(_) => Err(Damage::Unknown),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    const HEADER: Header = Header { sequence: 7, auth: Auth::None };

    fn frame_of(message: &Message) -> Vec<u8> {
        let mut frame = [0; MAX_FRAME];
        encode(&HEADER, message, &mut frame).unwrap().to_vec()
    }

    fn decode(bytes: &[u8]) -> Vec<Result<(Header, Message), Damage>> {
        let mut decoder = Decoder::default();
        bytes.iter().filter_map(|byte| decoder.push(*byte)).collect()
    }

    fn actuators() -> Message {
        Message::Actuators(ActuatorFrame { tick: 70_000, commands: Commands::safe(), step_clocks: 0 })
    }

    #[test]
    fn a_frame_comes_back_whole() {
        assert_eq!(decode(&frame_of(&actuators())), [Ok((HEADER, actuators()))]);
    }

    #[test]
    fn every_single_damaged_byte_is_noticed() {
        let good = frame_of(&actuators());
        for place in 0..good.len() - 1 {
            for flip in 1..=255_u8 {
                let mut bad = good.clone();
                bad[place] ^= flip;
                assert!(decode(&bad).iter().all(Result::is_err), "byte {place} xor {flip:#x} went through");
            }
        }
    }

    #[test]
    fn the_frame_after_a_damaged_one_is_read() {
        let mut bytes = frame_of(&actuators());
        bytes[5] ^= 0x10;
        bytes.extend(frame_of(&Message::Ready));
        let read = decode(&bytes);
        assert_eq!(read.last(), Some(&Ok((HEADER, Message::Ready))));
    }

    #[test]
    fn bytes_without_a_delimiter_are_dropped_once() {
        let mut decoder = Decoder::default();
        for _ in 0..10 * MAX_FRAME {
            assert_eq!(decoder.push(0x55), None);
        }
        assert_eq!(decoder.push(DELIMITER), Some(Err(Damage::Overlong)));
        assert_eq!(decoder.dropped, 1);
    }

    #[test]
    fn another_schema_is_named_and_left_over_bytes_are_refused() {
        let rebuilt = |change: &dyn Fn(&mut Vec<u8>)| {
            let mut plain = [0; MAX_FRAME];
            let used = write_plain(&HEADER, &Message::Ready, &mut plain).unwrap();
            let mut content = plain[..used - CRC_BYTES].to_vec();
            change(&mut content);
            let crc = crc32(&content);
            content.extend(crc.to_le_bytes());
            let mut frame = std::vec![0; cobs::max_encoding_length(content.len())];
            let end = cobs::encode(&content, &mut frame);
            frame.truncate(end);
            frame.push(DELIMITER);
            decode(&frame)
        };
        assert_eq!(rebuilt(&|c| c[0] ^= 1), [Err(Damage::OtherSchema(schema() ^ 1))]);
        assert_eq!(rebuilt(&|c| c.push(9)), [Err(Damage::Unknown)]);
    }

    /// The longest mission with the largest values, and with it the longest message there is.
    #[test]
    fn the_largest_configuration_fits_a_frame() {
        use crate::device::GpsFix;
        use crate::mission::{Course, MAX_HEADINGS, MAX_WAYPOINTS, Route};
        let place = GpsFix { lat_e7: i32::MIN, lon_e7: i32::MIN };
        let route = Route {
            places: [place; MAX_WAYPOINTS].into_iter().collect(),
            capture_radius_mm: i32::MIN,
            leg_time_s: u32::MAX,
        };
        for course in [Course::Waypoints(route), Course::Headings([u16::MAX; MAX_HEADINGS].into_iter().collect())] {
            let mission = Mission {
                yos: u16::MAX,
                surfacings: u16::MAX,
                dive_to_mm: i32::MIN,
                climb_to_mm: i32::MIN,
                dive_path_angle_cdeg: i16::MIN,
                climb_path_angle_cdeg: i16::MIN,
                dive_net_mass_g: i16::MIN,
                climb_net_mass_g: i16::MIN,
                course,
                drift_time_s: u32::MAX,
                flare_depth_mm: i32::MIN,
                surface_time_s: u16::MAX,
                altitude_mm: i32::MIN,
                abort_depth_mm: i32::MIN,
                max_duration_s: u32::MAX,
            };
            let parameters = largest_parameters();
            let message = Message::Configure(Configuration { mission, parameters });
            assert_eq!(decode(&frame_of(&message)), [Ok((HEADER, message))]);
        }
    }

    /// Each parameter takes the most bytes that an integer can.
    fn largest_parameters() -> Parameters {
        let bytes: Vec<u8> = crate::parameters::ROWS.iter().flat_map(|_| [0xff, 0xff, 0xff, 0xff, 0x0f]).collect();
        postcard::from_bytes(&bytes).unwrap()
    }
}
