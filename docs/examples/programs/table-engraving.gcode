; engraving, grbl 1.1, inches, zero at the table's lower left
G20G90G94
M3S9000
G0X9.2Y6.5Z.2
G1Z-.02F10
X9.25F30
G0Z.2
X11.8Y3.2 ; into the corner of the stop
G1Z-.02F10
G91
G1X.4F30
G0Z.22
G0X-2.6Y.9
X-.5Y2.6
G90
G1Z-.02F10
G2X8.7Y6.5I-.2J-.2F30
G0Z.2
; traverse: off
G0X4Y10.2
; traverse: on
G0X19.5Y10.2
G0X18.2Y6.4
G1Z-.02F10
G0Z.2
M5
$H
G0X0Y0
M2
