//! The application on an STM32F405, at its USART1.

#![no_std]
#![no_main]
