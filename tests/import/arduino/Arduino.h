// SPDX-License-Identifier: MIT
// As much of the Arduino API as the logger uses, on a board whose clock and pins the test moves.
#ifndef SIVID_TESTS_IMPORT_ARDUINO_H
#define SIVID_TESTS_IMPORT_ARDUINO_H

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

using std::int16_t;
using std::int32_t;
using std::size_t;
using std::uint16_t;
using std::uint32_t;
using std::uint8_t;

class Print {
public:
    virtual ~Print() = default;
    virtual size_t write(uint8_t byte) = 0;
    size_t println(char const* text) {
        size_t n = 2;
        for (; *text != '\0'; ++text) n += write(static_cast<uint8_t>(*text));
        write('\r');
        write('\n');
        return n;
    }
};

/// The board: what it sent, and what it sees.
struct board {
    std::string sent;
    uint32_t clock = 0;
    std::map<int, int> pins, pwm;
    void (*edge)() = nullptr;
    bool interrupts = true;
};
inline board& the_board() {
    static board b;
    return b;
}

class HardwareSerial : public Print {
public:
    void begin(unsigned long) {}
    size_t write(uint8_t byte) override {
        the_board().sent += static_cast<char>(byte);
        return 1;
    }
};
inline HardwareSerial Serial;

constexpr uint8_t A0 = 14, OUTPUT = 1, INPUT_PULLUP = 2, LOW = 0, HIGH = 1;
constexpr int CHANGE = 1;
inline void pinMode(uint8_t, uint8_t) {}
inline void digitalWrite(uint8_t pin, uint8_t level) { the_board().pins[pin] = level; }
inline int digitalRead(uint8_t pin) { return the_board().pins[pin]; }
inline void analogWrite(uint8_t pin, int value) { the_board().pwm[pin] = value; }
inline int analogRead(uint8_t pin) { return the_board().pins[pin]; }
inline uint32_t micros() { return the_board().clock; }
inline int digitalPinToInterrupt(uint8_t pin) { return pin; }
inline void attachInterrupt(int, void (*run)(), int) { the_board().edge = run; }
inline void noInterrupts() { the_board().interrupts = false; }
inline void interrupts() { the_board().interrupts = true; }

#endif
