"""What a sphere nest shows beside parameters: where the ball goes in the nest as rotary axes turn."""
