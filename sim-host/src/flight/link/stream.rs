//! Messages over a pair of file descriptors: FIFOs, a socket, a serial port.

use std::{
    collections::VecDeque,
    fs::File,
    io::{ErrorKind, Read, Write},
    os::{
        fd::{AsFd, OwnedFd},
        unix::net::UnixStream,
    },
    time::{Duration, Instant},
};

use nix::{
    errno::Errno,
    poll::{PollFd, PollFlags, PollTimeout, poll},
};
use shared::wire::{self, Auth, Damage, Decoder, Header, MAX_FRAME, Message};

/// A link on which messages are sent and awaited.
#[derive(Debug)]
pub struct Stream {
    from_firmware: File,
    to_firmware: File,
    decoder: Decoder,
    arrived: VecDeque<Message>,
    sequence: u32,
    hung_up: bool,
    log: Option<File>,
}

impl Stream {
    /// Takes two files; the one that is read from must not block.
    #[must_use]
    pub fn new(from_firmware: File, to_firmware: File) -> Self {
        Self {
            from_firmware,
            to_firmware,
            decoder: Decoder::default(),
            arrived: VecDeque::new(),
            sequence: 0,
            hung_up: false,
            log: None,
        }
    }

    /// Takes a socket.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn from_socket(socket: UnixStream) -> std::io::Result<Self> {
        socket.set_nonblocking(true)?;
        let to_firmware = socket.try_clone()?;
        Ok(Self::new(OwnedFd::from(socket).into(), OwnedFd::from(to_firmware).into()))
    }

    /// Writes down what both sides say from now on, byte for byte as it passes: it replays if it is the whole flight.
    pub fn log_to(&mut self, file: File) {
        self.log = Some(file);
    }

    fn log(&mut self, bytes: &[u8]) -> Result<(), String> {
        let Some(file) = &mut self.log else { return Ok(()) };
        file.write_all(bytes).map_err(|error| format!("the log of the link: {error}"))
    }

    /// Sends one message.
    ///
    /// # Errors
    /// One line: too long, or the link is gone.
    pub fn send(&mut self, message: &Message) -> Result<(), String> {
        let header = Header { sequence: self.sequence, auth: Auth::None };
        self.sequence = self.sequence.wrapping_add(1);
        let mut buffer = [0; MAX_FRAME];
        let frame = wire::encode(&header, message, &mut buffer).map_err(|_| "a message exceeds the link's frame")?;
        self.send_bytes(frame)
    }

    /// Sends bytes as they are, damaged frames for instance.
    ///
    /// # Errors
    /// One line: the link is gone, or its log cannot be written.
    pub fn send_bytes(&mut self, bytes: &[u8]) -> Result<(), String> {
        self.log(bytes)?;
        self.to_firmware.write_all(bytes).map_err(|error| format!("the link to the firmware broke: {error}"))
    }

    /// Waits for the next whole message.
    ///
    /// # Errors
    /// One line: nothing came in time, the link is gone, or a frame that no retry would make readable.
    pub fn receive(&mut self, patience: Duration) -> Result<Message, String> {
        let deadline = Instant::now() + patience;
        loop {
            if let Some(message) = self.arrived.pop_front() {
                return Ok(message);
            }
            if self.take_bytes()? {
                continue;
            }
            if self.hung_up {
                return Err("the firmware closed the link".into());
            }
            self.wait(deadline, patience)?;
        }
    }

    /// Takes what is there; tells whether anything was.
    fn take_bytes(&mut self) -> Result<bool, String> {
        let mut chunk = [0; MAX_FRAME];
        let received = match self.from_firmware.read(&mut chunk) {
            Ok(0) => return Ok(false), // A FIFO whose writer is gone or not there yet; `wait` knows which.
            Ok(received) => received,
            Err(error) if error.kind() == ErrorKind::WouldBlock => return Ok(false),
            Err(error) => return Err(format!("the link to the firmware broke: {error}")),
        };
        let received = &chunk[..received];
        self.log(received)?;
        for byte in received {
            match self.decoder.push(*byte) {
                Some(Ok((_, message))) => self.arrived.push_back(message),
                Some(Err(Damage::OtherSchema(theirs))) => {
                    let ours = wire::schema();
                    return Err(format!(
                        "the firmware speaks schema {theirs:08x}, this host {ours:08x}: build both from the same sources"
                    ));
                }
                // Counted by the decoder, and never acted on.
                Some(Err(Damage::Overlong | Damage::Corrupt | Damage::Unknown)) | None => {}
            }
        }
        Ok(true)
    }

    /// Waits for bytes or for the end of the link; what came before the end is still to be taken.
    fn wait(&mut self, deadline: Instant, patience: Duration) -> Result<(), String> {
        let left = deadline.saturating_duration_since(Instant::now());
        let timeout = PollTimeout::try_from(left).unwrap_or(PollTimeout::MAX);
        let mut descriptors = [PollFd::new(self.from_firmware.as_fd(), PollFlags::POLLIN)];
        let outcome = poll(&mut descriptors, timeout);
        let [descriptor] = descriptors;
        let events = descriptor.revents().unwrap_or(PollFlags::empty());
        self.hung_up = events.contains(PollFlags::POLLHUP);
        match outcome {
            Ok(0) if left.is_zero() => Err(format!("the firmware said nothing for {} s", patience.as_secs_f32())),
            Ok(_) | Err(Errno::EINTR) => Ok(()),
            Err(error) => Err(format!("the link to the firmware broke: {error}")),
        }
    }

    /// Frames from the firmware that arrived damaged.
    #[must_use]
    pub const fn dropped(&self) -> u32 {
        self.decoder.dropped
    }
}

#[cfg(test)]
mod tests {
    use std::io::{BufReader, Seek, SeekFrom};

    use super::*;
    use crate::flight::record::Frames;

    const SHORT: Duration = Duration::from_millis(50);

    fn pair() -> (Stream, UnixStream) {
        let (ours, theirs) = UnixStream::pair().unwrap();
        (Stream::from_socket(ours).unwrap(), theirs)
    }

    #[test]
    fn messages_arrive_whole_whatever_their_pieces() {
        let (mut ours, theirs) = pair();
        let mut theirs = Stream::from_socket(theirs).unwrap();
        theirs.send(&Message::Ready).unwrap();
        theirs.send(&Message::Ready).unwrap();
        assert_eq!(ours.receive(SHORT), Ok(Message::Ready));
        assert_eq!(ours.receive(SHORT), Ok(Message::Ready));
        let mut buffer = [0; MAX_FRAME];
        let frame = wire::encode(&Header { sequence: 0, auth: Auth::None }, &Message::Ready, &mut buffer).unwrap();
        let (start, end) = frame.split_at(3);
        theirs.send_bytes(start).unwrap();
        assert!(ours.receive(SHORT).is_err());
        theirs.send_bytes(end).unwrap();
        assert_eq!(ours.receive(SHORT), Ok(Message::Ready));
    }

    #[test]
    fn a_log_holds_both_sides_in_the_order_in_which_they_spoke() {
        let (mut ours, theirs) = pair();
        let mut theirs = Stream::from_socket(theirs).unwrap();
        let mut log = tempfile::tempfile().unwrap();
        ours.log_to(log.try_clone().unwrap());
        let said = [Message::Ready, Message::Refused(shared::wire::Refusal::OutOfOrder)];
        ours.send(&said[0]).unwrap();
        theirs.send(&said[1]).unwrap();
        ours.receive(SHORT).unwrap();
        log.seek(SeekFrom::Start(0)).unwrap();
        let read: Vec<_> = Frames::new(BufReader::new(log)).map(|frame| frame.unwrap().message).collect();
        assert_eq!(read, said);
    }

    #[test]
    fn silence_and_a_closed_link_are_told_apart() {
        let (mut ours, theirs) = pair();
        assert_eq!(ours.receive(SHORT).unwrap_err(), "the firmware said nothing for 0.05 s");
        drop(theirs);
        assert_eq!(ours.receive(Duration::from_secs(60)).unwrap_err(), "the firmware closed the link");
    }

    #[test]
    fn another_schema_is_named_and_damage_is_counted() {
        let (mut ours, mut theirs) = pair();
        theirs.write_all(&[3, 9, 9, 0]).unwrap();
        assert!(ours.receive(SHORT).is_err());
        assert_eq!(ours.dropped(), 1);
        let content = (wire::schema() ^ 1).to_le_bytes();
        let plain = [content, shared::checksum::crc32(&content).to_le_bytes()].concat();
        theirs.write_all(&[&[plain.len() as u8 + 1], plain.as_slice(), &[0]].concat()).unwrap();
        let error = ours.receive(SHORT).unwrap_err();
        assert!(error.contains("build both from the same sources"), "{error}");
    }
}
