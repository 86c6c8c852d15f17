// SPDX-License-Identifier: MIT
// One line of a log that `sivid import` reads as a serial source with "check_sum": "crc16":
//   4294966296,80,-512*7D1C
// whole numbers between commas, a star, and the CRC-16/CCITT of all before the star.
#ifndef SIVID_LINE_H
#define SIVID_LINE_H

#include <Arduino.h>

class SividLine {
public:
    explicit SividLine(Print& out) : out_(out) {}

    // The time stamp begins the line: micros(), which wraps after 2^32 us ("counter_bits": 32).
    void begin(uint32_t time) {
        sum_ = 0xFFFF;
        digits(time);
    }
    void field(int32_t x) {
        put(',');
        uint32_t magnitude = static_cast<uint32_t>(x);
        if (x < 0) {
            put('-');
            magnitude = 0u - magnitude;
        }
        digits(magnitude);
    }
    void end() {
        const uint16_t sum = sum_;
        out_.write(static_cast<uint8_t>('*'));
        for (int shift = 12; shift >= 0; shift -= 4)
            out_.write(static_cast<uint8_t>("0123456789ABCDEF"[(sum >> shift) & 0xF]));
        out_.write(static_cast<uint8_t>('\n'));
    }

private:
    void digits(uint32_t x) {
        char text[10];
        uint8_t count = 0;
        do {
            text[count++] = static_cast<char>('0' + x % 10);
            x /= 10;
        } while (x > 0);
        while (count > 0) put(text[--count]);
    }
    void put(char c) {
        sum_ = static_cast<uint16_t>(sum_ ^ (static_cast<uint16_t>(static_cast<uint8_t>(c)) << 8));
        for (uint8_t bit = 0; bit < 8; ++bit)
            sum_ = static_cast<uint16_t>((sum_ & 0x8000) != 0 ? (sum_ << 1) ^ 0x1021 : sum_ << 1);
        out_.write(static_cast<uint8_t>(c));
    }

    Print& out_;
    uint16_t sum_ = 0xFFFF;
};

#endif
