//! QEMU as a child process, with the firmware in it.

use std::{
    fs::{self, File, OpenOptions},
    io::{Read, Write},
    os::unix::{
        fs::OpenOptionsExt,
        net::{UnixListener, UnixStream},
    },
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use nix::{fcntl::OFlag, sys::stat::Mode, unistd::mkfifo};

use super::Stream;

const QEMU: &str = "qemu-system-arm";
/// Time for QEMU to start and the firmware to open its end; a loaded machine is slow.
const START: Duration = Duration::from_secs(30);
const RETRY: Duration = Duration::from_millis(2);
const MONITOR: &str = "monitor.sock";

/// What is emulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Machine {
    /// Two FIFOs by semihosting, with 128 ns of virtual time per instruction.
    Mps2An386,
    /// The F405's first UART on a socket, its second one into the log.
    NetduinoPlus2,
}

/// A running emulator; it is killed when this is dropped.
#[derive(Debug)]
pub struct Emulator {
    child: Child,
    folder: PathBuf,
}

impl Emulator {
    /// Starts an image. Pipes, sockets and logs go to `folder`, whose path must be short enough for a socket.
    ///
    /// # Errors
    /// One line: no emulator, no image, or firmware that does not open its link.
    pub fn start(machine: Machine, image: &Path, folder: &Path) -> Result<(Self, Stream), String> {
        let image = image.canonicalize().map_err(|error| format!("{}: {error}", image.display()))?;
        match machine {
            Machine::Mps2An386 => Self::start_on_fifos(&image, folder),
            Machine::NetduinoPlus2 => Self::start_on_socket(&image, folder),
        }
    }

    fn start_on_fifos(image: &Path, folder: &Path) -> Result<(Self, Stream), String> {
        let [to_firmware, from_firmware] = ["to-firmware", "from-firmware"].map(|name| folder.join(name));
        for fifo in [&to_firmware, &from_firmware] {
            mkfifo(fifo, Mode::S_IRUSR | Mode::S_IWUSR).map_err(|error| format!("{}: {error}", fifo.display()))?;
        }
        let machine = ["-M", "mps2-an386", "-icount", "shift=7"];
        let link = ["-semihosting-config", "enable=on,target=native", "-serial", "none"];
        let mut emulator = Self::spawn(image, folder, &[machine, link].concat())?;
        let not_blocking = OFlag::O_NONBLOCK.bits();
        // A FIFO cannot be opened to write without blocking until somebody reads it.
        let writer = OpenOptions::new().write(true).custom_flags(not_blocking).clone();
        let to_firmware = emulator.retry(|| writer.open(&to_firmware))?;
        let reader = OpenOptions::new().read(true).custom_flags(not_blocking).open(&from_firmware);
        let from_firmware = reader.map_err(|error| format!("{}: {error}", from_firmware.display()))?;
        Ok((emulator, Stream::new(from_firmware, to_firmware)))
    }

    fn start_on_socket(image: &Path, folder: &Path) -> Result<(Self, Stream), String> {
        let path = folder.join("uart.sock");
        let broken = |error| format!("{}: {error}", path.display());
        let listener = UnixListener::bind(&path).map_err(broken)?;
        listener.set_nonblocking(true).map_err(broken)?;
        let arguments = ["-M", "netduinoplus2", "-serial", "unix:uart.sock", "-serial", "file:log.defmt"];
        let mut emulator = Self::spawn(image, folder, &arguments)?;
        let (socket, _) = emulator.retry(|| listener.accept())?;
        Ok((emulator, Stream::from_socket(socket).map_err(broken)?))
    }

    fn spawn(image: &Path, folder: &Path, arguments: &[&str]) -> Result<Self, String> {
        let complaints = File::create(folder.join("qemu.log")).map_err(|error| format!("qemu.log: {error}"))?;
        let child = Command::new(QEMU)
            .args(["-display", "none", "-monitor", &format!("unix:{MONITOR},server=on,wait=off")])
            .args(arguments)
            .arg("-kernel")
            .arg(image)
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(complaints)
            .spawn()
            .map_err(|error| format!("{QEMU}: {error} (is it installed?)"))?;
        Ok(Self { child, folder: folder.to_owned() })
    }

    /// Tries until it works, the emulator is gone, or its time to start is over.
    fn retry<T>(&mut self, attempt: impl Fn() -> std::io::Result<T>) -> Result<T, String> {
        let deadline = Instant::now() + START;
        loop {
            match attempt() {
                Ok(done) => return Ok(done),
                Err(error) if Instant::now() > deadline => {
                    return Err(format!("the firmware did not open its link within {} s: {error}", START.as_secs()));
                }
                Err(_) => {}
            }
            if let Some(end) = self.end() {
                return Err(end);
            }
            thread::sleep(RETRY);
        }
    }

    /// How the emulation ended, in one line, if it did.
    pub fn end(&mut self) -> Option<String> {
        let status = self.child.try_wait().ok()??;
        let complaints = fs::read_to_string(self.folder.join("qemu.log")).unwrap_or_default();
        Some(format!("the emulation ended with {status} {}", complaints.lines().last().unwrap_or_default()))
    }

    /// Waits for the emulation to end by itself, and tells whether it did so with success.
    ///
    /// # Errors
    /// One line: it went on.
    pub fn wait(&mut self, patience: Duration) -> Result<bool, String> {
        let deadline = Instant::now() + patience;
        while Instant::now() < deadline {
            match self.child.try_wait() {
                Ok(Some(status)) => return Ok(status.success()),
                Ok(None) => thread::sleep(RETRY),
                Err(error) => return Err(format!("{QEMU}: {error}")),
            }
        }
        Err(format!("the emulation still ran after {} s", patience.as_secs_f32()))
    }

    /// What the firmware has logged so far, as defmt frames.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn log(&self) -> std::io::Result<Vec<u8>> {
        fs::read(self.folder.join("log.defmt"))
    }

    /// Gives QEMU's monitor a command and returns what it prints.
    ///
    /// Not while firmware waits on a FIFO: semihosting holds the whole emulator until the host says something.
    ///
    /// # Errors
    /// One line: the monitor does not answer.
    pub fn monitor(&self, command: &str) -> Result<String, String> {
        const PROMPT: &str = "(qemu) ";
        let broken = |error| format!("QEMU's monitor: {error}");
        let mut socket = UnixStream::connect(self.folder.join(MONITOR)).map_err(broken)?;
        socket.set_read_timeout(Some(START)).map_err(broken)?;
        read_until(&mut socket, PROMPT).map_err(broken)?;
        socket.write_all(format!("{command}\n").as_bytes()).map_err(broken)?;
        let answer = read_until(&mut socket, PROMPT).map_err(broken)?;
        // The first line echoes the command, with the cursor movements of a terminal.
        Ok(answer.lines().skip(1).filter(|line| !line.starts_with(PROMPT)).collect::<Vec<_>>().join("\n"))
    }
}

fn read_until(socket: &mut UnixStream, end: &str) -> std::io::Result<String> {
    let mut text = Vec::new();
    let mut byte = [0];
    while !text.ends_with(end.as_bytes()) {
        socket.read_exact(&mut byte)?;
        text.extend(byte);
    }
    Ok(String::from_utf8_lossy(&text).into_owned())
}

impl Drop for Emulator {
    fn drop(&mut self) {
        // Either may fail only because the child is gone already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
