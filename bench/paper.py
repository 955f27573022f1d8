# SPDX-License-Identifier: MIT
"""Rows of Tables 2 and 3 of the paper: its own meshes, measured by its authors."""

from dataclasses import dataclass


@dataclass(frozen=True)
class PaperRow:
    mesh: str
    scheme: str
    tets: int
    theta_min: float
    theta_max: float
    lambda_percent: float
    seconds: float


TABLE_2 = [
    PaperRow("Tire", "Grummp", 11_019, 3.36, 172.38, 4.21, 0.09),
    PaperRow("Tire", "Stellar", 10_936, 3.00, 172.38, 4.23, 0.07),
    PaperRow("Tire", "shell transformation", 10_906, 3.36, 172.38, 4.42, 0.21),
    PaperRow("Patient-organs02", "Grummp", 265_086, 5.68, 165.38, 3.46, 2.6),
    PaperRow("Patient-organs02", "Stellar", 261_485, 6.55, 167.70, 2.98, 2.6),
    PaperRow("Patient-organs02", "shell transformation", 259_959, 11.21, 162.59, 2.81, 5.9),
    PaperRow("F6", "Grummp", 955_584, 0.78, 178.4, 0.75, 9.8),
    PaperRow("F6", "Stellar", 951_623, 0.73, 178.7, 0.58, 4.6),
    PaperRow("F6", "shell transformation", 946_534, 3.69, 174.85, 0.31, 5.7),
    PaperRow("F16", "Grummp", 16_854_123, 2.4e-4, 180.0, 0.74, 258.0),
    PaperRow("F16", "Stellar", 16_791_528, 1.3e-4, 180.0, 0.57, 72.6),
    PaperRow("F16", "shell transformation", 16_682_773, 3.80, 174.20, 0.31, 85.3),
    PaperRow("Bridge", "Grummp", 35_233_789, 3.0e-5, 180.0, 0.81, 542),
    PaperRow("Bridge", "Stellar", 35_081_252, 9.2e-5, 180.0, 0.62, 160.8),
    PaperRow("Bridge", "shell transformation", 34_853_521, 8.6e-4, 180.0, 0.36, 192.2),
]

TABLE_3 = [
    PaperRow("Tire", "Grummp", 11_039, 13.67, 158.55, 1.7, 0.5),
    PaperRow("Tire", "Stellar", 10_973, 23.4, 148.1, 0.15, 106),
    PaperRow("Tire", "shell transformation", 11_840, 20.67, 157.45, 0.26, 1.0),
    PaperRow("Patient-organs02", "Grummp", 264_954, 8.93, 160.40, 2.91, 21),
    PaperRow("Patient-organs02", "Stellar", 227_775, 31.7, 141.58, 0, 3220),
    PaperRow("Patient-organs02", "shell transformation", 266_631, 20.52, 149.93, 8.3e-3, 16),
    PaperRow("F6", "Grummp", 955_512, 0.78, 178.4, 0.65, 43),
    PaperRow("F6", "Stellar", 918_434, 18.2, 158.7, 5.9e-3, 1193),
    PaperRow("F6", "shell transformation", 935_608, 10.64, 159.79, 0.017, 26),
    PaperRow("F16", "Grummp", 16_854_105, 2.4e-4, 179.99, 0.63, 884),
    PaperRow("F16", "Stellar", 16_360_678, 3.8, 174.2, 0.027, 9882),
    PaperRow("F16", "shell transformation", 16_666_517, 3.8, 174.2, 0.013, 522),
    PaperRow("Bridge", "Grummp", 35_233_695, 3.0e-5, 179.99, 0.71, 1521),
    PaperRow("Bridge", "Stellar", 34_188_981, 7.5, 171.5, 0.13, 21779),
    PaperRow("Bridge", "shell transformation", 33_698_234, 5.79, 172.55, 0.13, 1412),
]
