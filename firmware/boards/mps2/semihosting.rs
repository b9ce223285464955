//! Files of the host, through the emulator: what the `BKPT` of semihosting offers.

#![allow(unsafe_code, reason = "the host works on the addresses that it is given")]

use core::ffi::CStr;

use cortex_m_semihosting::{nr::open, syscall};
use embedded_io::{ErrorKind, ErrorType, Read, Write};

/// An open file of the host.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HostFile {
    handle: usize,
}

impl HostFile {
    /// Opens a file or a FIFO to read; a FIFO waits for its writer.
    pub(crate) fn to_read(path: &CStr) -> Option<Self> {
        Self::open(path, open::R_BINARY)
    }

    /// Opens a file or a FIFO to write; a FIFO waits for its reader.
    pub(crate) fn to_write(path: &CStr) -> Option<Self> {
        Self::open(path, open::W_TRUNC_BINARY)
    }

    fn open(path: &CStr, mode: usize) -> Option<Self> {
        // SAFETY: the host reads the path's bytes up to its NUL, and only during the call.
        let handle = unsafe { syscall!(OPEN, path.as_ptr(), mode, path.count_bytes()) };
        (handle != usize::MAX).then_some(Self { handle })
    }
}

/// Both directions of the link.
#[derive(Debug)]
pub(crate) struct HostLink {
    /// What the host says.
    pub(crate) from_host: HostFile,
    /// What the host hears.
    pub(crate) to_host: HostFile,
}

impl ErrorType for HostFile {
    type Error = ErrorKind;
}

impl ErrorType for HostLink {
    type Error = ErrorKind;
}

impl Read for HostLink {
    /// Waits until there is something; 0 once the host closed its end.
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, ErrorKind> {
        let (bytes, length) = (buffer.as_mut_ptr(), buffer.len());
        // SAFETY: the host writes at most `length` bytes into the buffer, and only during the call.
        let not_read = unsafe { syscall!(READ, self.from_host.handle, bytes, length) };
        length.checked_sub(not_read).ok_or(ErrorKind::Other)
    }
}

impl Write for HostFile {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, ErrorKind> {
        // SAFETY: the host reads the bytes given, and only during the call.
        let not_written = unsafe { syscall!(WRITE, self.handle, bytes.as_ptr(), bytes.len()) };
        bytes.len().checked_sub(not_written).filter(|written| *written > 0).ok_or(ErrorKind::Other)
    }

    fn flush(&mut self) -> Result<(), ErrorKind> {
        Ok(())
    }
}

impl Write for HostLink {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, ErrorKind> {
        self.to_host.write(bytes)
    }

    fn flush(&mut self) -> Result<(), ErrorKind> {
        self.to_host.flush()
    }
}
