// SPDX-License-Identifier: MIT
// Drives a motor by steps of PWM and logs  t_us,pwm,enc,adc*CRC  every 5 ms; ../mapping.json imports
// what a terminal program saves of it. Replace pins, excitation and readings by yours.
#include "sivid_line.h"

const uint8_t pwm_pin = 9, direction_pin = 8, encoder_a = 2, encoder_b = 3, current_pin = A0;
const uint32_t period = 5000; // us
const uint32_t hold = 40;     // periods for which a step of the PWM lasts

volatile int32_t count = 0; // of the encoder; 32 bits: the mapping needs no "counter_bits" for it
uint32_t next_time = 0, periods = 0, random_state = 1;
int16_t pwm = 0;

void on_edge() {
    if (digitalRead(encoder_a) == digitalRead(encoder_b))
        count = count + 1;
    else
        count = count - 1;
}

// A step of the excitation: -255 to 255, repeatable.
int16_t next_pwm() {
    random_state = random_state * 1664525u + 1013904223u;
    return static_cast<int16_t>(static_cast<int32_t>(random_state >> 16) % 511 - 255);
}

void setup() {
    Serial.begin(115200); // 24 bytes every 5 ms are 4800 a second; 11520 go through
    pinMode(direction_pin, OUTPUT);
    pinMode(encoder_a, INPUT_PULLUP);
    pinMode(encoder_b, INPUT_PULLUP);
    attachInterrupt(digitalPinToInterrupt(encoder_a), on_edge, CHANGE);
    Serial.println("# sivid_logger: t_us,pwm,enc,adc*CRC16");
    next_time = micros();
}

void loop() {
    if (static_cast<int32_t>(micros() - next_time) < 0) return;
    next_time += period;
    if (periods++ % hold == 0) pwm = next_pwm();

    // Input, time and readings belong together: the PWM holds from this time on, and the time is
    // read where the encoder is.
    digitalWrite(direction_pin, pwm < 0 ? HIGH : LOW);
    analogWrite(pwm_pin, pwm < 0 ? -pwm : pwm);
    noInterrupts();
    const uint32_t time = micros();
    const int32_t angle = count;
    interrupts();
    const int current = analogRead(current_pin);

    SividLine line(Serial);
    line.begin(time);
    line.field(pwm);
    line.field(angle);
    line.field(current);
    line.end();
}
