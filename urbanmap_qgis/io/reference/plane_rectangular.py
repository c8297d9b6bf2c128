"""The zone of the Japan Plane Rectangular coordinate system in which a place lies.

By law (Ministry of Land, Infrastructure and Transport, notification 9 of 2002) a zone is a group of
prefectures, in Hokkaido of municipalities, and of islands between given meridians and parallels. Borders of
prefectures are not known here, so a place on the main islands takes the zone of the nearest town of a table
in which the zones are those of the law. That is right but for a strip along the borders; the nearest meridian
would put Takamatsu into the zone of Okayama and Fukuyama into that of Shikoku. Near a border the user should
choose the reference system.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.spatial import cKDTree

# JGD2011 / Japan Plane Rectangular CS I is EPSG:6669, and so on to XIX, EPSG:6687.
_EPSG_BEFORE_ZONE_1 = 6668
ZONE_NAMES = ("I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X", "XI", "XII", "XIII", "XIV", "XV",
              "XVI", "XVII", "XVIII", "XIX")

# Latitude and longitude (degrees, to about 0.05) of towns in each zone, denser along the borders.
TOWNS: dict[int, dict[str, tuple[float, float]]] = {
    1: {
        "Nagasaki": (32.75, 129.88), "Sasebo": (33.18, 129.72), "Isahaya": (32.84, 130.05),
        "Shimabara": (32.79, 130.37), "Omura": (32.90, 129.96), "Hirado": (33.37, 129.55),
        "Matsuura": (33.34, 129.71), "Goto": (32.70, 128.84), "Iki": (33.75, 129.69),
        "Tsushima": (34.20, 129.29), "Unzen": (32.83, 130.19), "Minamishimabara": (32.66, 130.30),
        "Hasami": (33.14, 129.90), "Kamitsushima": (34.65, 129.45)},
    2: {
        "Fukuoka": (33.59, 130.40), "Kitakyushu": (33.88, 130.88), "Moji": (33.94, 130.96),
        "Kurume": (33.32, 130.51), "Omuta": (33.03, 130.45), "Buzen": (33.61, 131.13),
        "Saga": (33.26, 130.30), "Karatsu": (33.45, 129.97), "Imari": (33.27, 129.88),
        "Takeo": (33.19, 130.02), "Arita": (33.19, 129.85), "Tara": (33.02, 130.18),
        "Kashima (Saga)": (33.10, 130.10), "Genkai": (33.47, 129.87), "Ureshino": (33.13, 130.00),
        "Kumamoto": (32.80, 130.71), "Arao": (32.99, 130.43), "Tamana": (32.93, 130.56),
        "Amakusa": (32.46, 130.19), "Reihoku": (32.51, 130.04), "Ushibuka": (32.19, 130.02),
        "Kami-Amakusa": (32.59, 130.43), "Yatsushiro": (32.51, 130.60), "Hitoyoshi": (32.21, 130.76),
        "Aso": (32.95, 131.12), "Oita": (33.24, 131.61), "Hita": (33.32, 130.94),
        "Nakatsu": (33.60, 131.19), "Kunisaki": (33.56, 131.73), "Saiki": (32.96, 131.90),
        "Miyazaki": (31.91, 131.42), "Nobeoka": (32.58, 131.66), "Miyakonojo": (31.72, 131.06),
        "Kagoshima": (31.60, 130.56), "Satsumasendai": (31.81, 130.30), "Akune": (32.01, 130.19),
        "Nagashima": (32.20, 130.18), "Makurazaki": (31.27, 130.30), "Kanoya": (31.38, 130.85),
        "Nishinoomote": (30.73, 131.00), "Yakushima": (30.39, 130.66), "Munakata": (33.81, 130.54),
        "Minamisatsuma": (31.42, 130.32)},
    3: {
        "Yamaguchi": (34.19, 131.47), "Shimonoseki": (33.96, 130.94), "Hikoshima": (33.93, 130.90),
        "Ube": (33.95, 131.25), "Shunan": (34.06, 131.81), "Iwakuni": (34.17, 132.22),
        "Yanai": (33.96, 132.10), "Suo-Oshima": (33.93, 132.20), "Hagi": (34.41, 131.40),
        "Nagato": (34.37, 131.18), "Toyoura": (34.15, 130.93), "Matsue": (35.47, 133.05),
        "Yasugi": (35.43, 133.25), "Izumo": (35.37, 132.75), "Okuizumo": (35.20, 133.00),
        "Hamada": (34.90, 132.08), "Masuda": (34.67, 131.84), "Okinoshima": (36.21, 133.33),
        "Hiroshima": (34.39, 132.46), "Kure": (34.25, 132.57), "Takehara": (34.34, 132.91),
        "Mihara": (34.40, 133.08), "Onomichi": (34.41, 133.20), "Setoda": (34.31, 133.09),
        "Innoshima": (34.29, 133.18), "Fukuyama": (34.49, 133.36), "Kannabe": (34.54, 133.39),
        "Tomo": (34.38, 133.38), "Miyoshi": (34.81, 132.85), "Shobara": (34.86, 133.02),
        "Tojo": (34.89, 133.27), "Jinsekikogen": (34.70, 133.25), "Osakikamijima": (34.27, 132.92),
        "Mihonoseki": (35.56, 133.30)},
    4: {
        "Takamatsu": (34.34, 134.04), "Marugame": (34.29, 133.80), "Sakaide": (34.32, 133.86),
        "Mitoyo": (34.18, 133.72), "Kanonji": (34.13, 133.66), "Tonosho": (34.49, 134.19),
        "Uchinomi": (34.48, 134.30), "Naoshima": (34.46, 133.99), "Higashikagawa": (34.24, 134.36),
        "Sanuki": (34.32, 134.17), "Matsuyama": (33.84, 132.77), "Imabari": (34.07, 133.00),
        "Omishima": (34.24, 133.00), "Kamijima": (34.26, 133.20), "Saijo": (33.92, 133.18),
        "Shikokuchuo": (33.98, 133.55), "Yawatahama": (33.46, 132.42), "Uwajima": (33.22, 132.56),
        "Ikata": (33.49, 132.35), "Misaki": (33.39, 132.12), "Ainan": (32.96, 132.58),
        "Nakajima": (33.97, 132.63), "Tokushima": (34.07, 134.55), "Naruto": (34.17, 134.61),
        "Anan": (33.92, 134.66), "Miyoshi": (34.03, 133.81), "Kaiyo": (33.60, 134.35),
        "Kochi": (33.56, 133.53), "Shimanto": (32.99, 132.93), "Muroto": (33.29, 134.15),
        "Sukumo": (32.94, 132.73)},
    5: {
        "Kobe": (34.69, 135.19), "Himeji": (34.82, 134.69), "Akashi": (34.64, 135.00),
        "Nishinomiya": (34.74, 135.34), "Amagasaki": (34.73, 135.41), "Itami": (34.78, 135.40),
        "Kawanishi": (34.83, 135.42), "Takarazuka": (34.80, 135.36), "Inagawa": (34.90, 135.38),
        "Sanda": (34.89, 135.23), "Tamba-Sasayama": (35.08, 135.22), "Tamba": (35.18, 135.04),
        "Toyooka": (35.54, 134.82), "Asago": (35.34, 134.85), "Izushi": (35.46, 134.87),
        "Shin'onsen": (35.62, 134.45), "Ako": (34.76, 134.39), "Sumoto": (34.34, 134.90),
        "Minamiawaji": (34.30, 134.78), "Fukura": (34.25, 134.72), "Tottori": (35.50, 134.24),
        "Kurayoshi": (35.43, 133.83), "Yonago": (35.43, 133.33), "Sakaiminato": (35.54, 133.23),
        "Nichinan": (35.16, 133.31), "Nanbu": (35.34, 133.33), "Okayama": (34.66, 133.92),
        "Kurashiki": (34.59, 133.77), "Tamano": (34.49, 133.95), "Kojima": (34.46, 133.81),
        "Kasaoka": (34.51, 133.51), "Ibara": (34.60, 133.46), "Niimi": (34.98, 133.47),
        "Takahashi": (34.79, 133.62), "Tsuyama": (35.07, 134.00), "Bizen": (34.75, 134.19),
        "Setouchi": (34.66, 134.09), "Ushimado": (34.62, 134.16)},
    6: {
        "Kyoto": (35.01, 135.77), "Fukuchiyama": (35.30, 135.13), "Maizuru": (35.47, 135.39),
        "Miyazu": (35.54, 135.20), "Kyotango": (35.62, 135.06), "Kumihama": (35.60, 134.90),
        "Ayabe": (35.30, 135.26), "Nantan": (35.11, 135.47), "Kyotamba": (35.16, 135.42),
        "Kameoka": (35.01, 135.57), "Osaka": (34.69, 135.50), "Toyonaka": (34.78, 135.47),
        "Ikeda": (34.82, 135.43), "Nose": (34.97, 135.41), "Sakai": (34.57, 135.48),
        "Izumisano": (34.41, 135.33), "Misaki (Osaka)": (34.32, 135.14), "Fukui": (36.06, 136.22),
        "Awara": (36.21, 136.23), "Sakai (Fukui)": (36.17, 136.23), "Katsuyama": (36.06, 136.50),
        "Ono": (35.98, 136.49), "Izumi (Ono)": (35.92, 136.67), "Tsuruga": (35.65, 136.06),
        "Obama": (35.50, 135.75), "Takahama": (35.49, 135.55), "Otsu": (35.02, 135.85),
        "Hikone": (35.27, 136.26), "Nagahama": (35.38, 136.27), "Maibara": (35.31, 136.29),
        "Ibuki": (35.39, 136.38), "Samegai": (35.33, 136.35), "Tsu": (34.72, 136.51),
        "Kuwana": (35.06, 136.68), "Kisosaki": (35.08, 136.73), "Inabe": (35.12, 136.56),
        "Toba": (34.48, 136.84), "Shima": (34.33, 136.83), "Kumano": (33.89, 136.10),
        "Owase": (34.07, 136.19), "Nara": (34.69, 135.80), "Gojo": (34.35, 135.69),
        "Totsukawa": (33.99, 135.79), "Wakayama": (34.23, 135.17), "Shirahama": (33.68, 135.35),
        "Shingu": (33.72, 135.99)},
    7: {
        "Kanazawa": (36.56, 136.66), "Kaga": (36.30, 136.31), "Hakusan": (36.51, 136.57),
        "Shiramine": (36.17, 136.63), "Nanao": (37.04, 136.97), "Wajima": (37.39, 136.90),
        "Suzu": (37.44, 137.26), "Toyama": (36.70, 137.21), "Takaoka": (36.75, 137.03),
        "Kurobe": (36.87, 137.45), "Asahi (Toyama)": (36.95, 137.56), "Gifu": (35.42, 136.76),
        "Ogaki": (35.36, 136.61), "Sekigahara": (35.37, 136.47), "Kaizu": (35.22, 136.64),
        "Gujo": (35.75, 136.96), "Shirotori": (35.88, 136.87), "Takayama": (36.15, 137.25),
        "Kamioka": (36.33, 137.30), "Shirakawa": (36.26, 136.91), "Hirayu": (36.19, 137.55),
        "Gero": (35.81, 137.24), "Nakatsugawa": (35.49, 137.50), "Magome": (35.53, 137.56),
        "Ena": (35.45, 137.41), "Ibigawa": (35.49, 136.57), "Nagoya": (35.18, 136.91),
        "Yatomi": (35.11, 136.73), "Aisai": (35.15, 136.73), "Toyota": (35.08, 137.16),
        "Inabu": (35.21, 137.51), "Toyohashi": (34.77, 137.39), "Shinshiro": (34.90, 137.50),
        "Horai": (34.93, 137.58), "Toei": (35.08, 137.70), "Toyone": (35.15, 137.72),
        "Tahara": (34.67, 137.26), "Irago": (34.59, 137.03), "Handa": (34.89, 136.94),
        "Minamichita": (34.72, 136.93)},
    8: {
        "Niigata": (37.92, 139.04), "Nagaoka": (37.45, 138.85), "Joetsu": (37.15, 138.24),
        "Itoigawa": (37.04, 137.86), "Oumi": (37.02, 137.79), "Murakami": (38.22, 139.48),
        "Fuya": (38.50, 139.54), "Sekikawa": (38.09, 139.56), "Shibata": (37.95, 139.33),
        "Aga": (37.67, 139.46), "Tsunan": (37.01, 138.65), "Minamiuonuma": (37.07, 138.88),
        "Yuzawa": (36.93, 138.82), "Uonuma": (37.23, 138.96), "Sado": (38.02, 138.37),
        "Nagano": (36.65, 138.18), "Matsumoto": (36.24, 137.97), "Azumi": (36.18, 137.78),
        "Omachi": (36.50, 137.85), "Hakuba": (36.70, 137.86), "Iiyama": (36.85, 138.37),
        "Ueda": (36.40, 138.25), "Sugadaira": (36.53, 138.33), "Karuizawa": (36.35, 138.60),
        "Saku": (36.25, 138.48), "Kawakami": (35.97, 138.58), "Kiso": (35.84, 137.69),
        "Nagiso": (35.60, 137.61), "Otaki": (35.81, 137.55), "Iida": (35.51, 137.82),
        "Achi": (35.44, 137.75), "Neba": (35.25, 137.58), "Tenryu": (35.28, 137.85),
        "Yamanouchi": (36.74, 138.41), "Kofu": (35.66, 138.57), "Otsuki": (35.61, 138.94),
        "Uenohara": (35.63, 139.11), "Kosuge": (35.76, 138.94), "Doshi": (35.53, 139.03),
        "Yamanakako": (35.41, 138.86), "Hokuto": (35.78, 138.42), "Koshu": (35.70, 138.73),
        "Shizuoka": (34.98, 138.38), "Hamamatsu": (34.71, 137.73), "Kosai": (34.72, 137.53),
        "Mikkabi": (34.80, 137.55), "Tenryu (Hamamatsu)": (34.87, 137.82), "Sakuma": (35.08, 137.80),
        "Gotemba": (35.31, 138.93), "Oyama": (35.36, 138.99), "Mishima": (35.12, 138.92),
        "Atami": (35.10, 139.07), "Ito": (34.97, 139.10), "Shimoda": (34.68, 138.95)},
    9: {
        "Tokyo": (35.69, 139.70), "Hachioji": (35.67, 139.32), "Okutama": (35.81, 139.10),
        "Hinohara": (35.73, 139.15), "Oshima": (34.75, 139.36), "Miyakejima": (34.08, 139.48),
        "Niijima": (34.38, 139.26), "Kozushima": (34.21, 139.13), "Hachijo": (33.11, 139.79),
        "Aogashima": (32.47, 139.76), "Torishima": (30.48, 140.30), "Yokohama": (35.45, 139.64),
        "Odawara": (35.26, 139.15), "Yugawara": (35.15, 139.11), "Manazuru": (35.16, 139.14),
        "Hakone": (35.23, 139.05), "Yamakita": (35.36, 139.08), "Sagamiko": (35.61, 139.19),
        "Fujino": (35.61, 139.14), "Saitama": (35.86, 139.65), "Chichibu": (35.99, 139.09),
        "Otaki (Chichibu)": (35.94, 138.93), "Kumagaya": (36.15, 139.39), "Chiba": (35.61, 140.12),
        "Choshi": (35.73, 140.83), "Tateyama": (34.99, 139.87), "Maebashi": (36.39, 139.06),
        "Takasaki": (36.32, 139.00), "Annaka (Matsuida)": (36.32, 138.80),
        "Shimonita": (36.21, 138.79), "Ueno": (36.08, 138.78), "Naganohara": (36.55, 138.64),
        "Tsumagoi": (36.52, 138.53), "Kusatsu": (36.62, 138.60), "Minakami": (36.68, 138.97),
        "Doai": (36.83, 138.97), "Numata": (36.65, 139.04), "Katashina": (36.77, 139.23),
        "Utsunomiya": (36.56, 139.88), "Nikko": (36.75, 139.60), "Nasushiobara": (36.96, 140.05),
        "Mito": (36.37, 140.47), "Hitachi": (36.60, 140.65), "Fukushima": (37.76, 140.47),
        "Date": (37.82, 140.56), "Kunimi": (37.88, 140.55), "Soma": (37.80, 140.92),
        "Shinchi": (37.88, 140.92), "Iwaki": (37.05, 140.89), "Koriyama": (37.40, 140.36),
        "Aizuwakamatsu": (37.49, 139.93), "Nishiaizu": (37.59, 139.65), "Kitakata": (37.65, 139.87),
        "Hinoemata": (37.02, 139.39), "Tadami": (37.35, 139.32), "Minamiaizu": (37.20, 139.77),
        "Inawashiro": (37.56, 140.10)},
    10: {
        "Aomori": (40.82, 140.74), "Hachinohe": (40.51, 141.49), "Oma": (41.53, 140.91),
        "Mutsu": (41.29, 141.18), "Minmaya": (41.20, 140.44), "Akita": (39.72, 140.10),
        "Noshiro": (40.21, 140.03), "Nikaho": (39.20, 139.91), "Yuzawa (Akita)": (39.16, 140.49),
        "Yamagata": (38.24, 140.36), "Yonezawa": (37.92, 140.12), "Sakata": (38.91, 139.84),
        "Tsuruoka": (38.73, 139.83), "Atsumi": (38.61, 139.59), "Oguni": (38.06, 139.74),
        "Iide": (38.05, 139.99), "Tobishima": (39.19, 139.55), "Morioka": (39.70, 141.15),
        "Miyako": (39.64, 141.96), "Ofunato": (39.08, 141.71), "Kuji": (40.19, 141.78),
        "Sendai": (38.27, 140.87), "Shiroishi": (38.00, 140.62), "Kakuda": (37.98, 140.78),
        "Marumori": (37.91, 140.77), "Watari": (38.04, 140.85), "Yamamoto": (37.96, 140.88),
        "Shichikashuku": (37.99, 140.44), "Kesennuma": (38.91, 141.57), "Ishinomaki": (38.43, 141.30)},
    11: {
        "Otaru": (43.19, 140.99), "Zenibako": (43.14, 141.16), "Hakodate": (41.77, 140.73),
        "Toi": (41.78, 141.13), "Matsumae": (41.43, 140.11), "Esashi": (41.87, 140.13),
        "Okushiri": (42.17, 139.52), "Yakumo": (42.25, 140.27), "Oshamambe": (42.51, 140.38),
        "Setana": (42.45, 139.85), "Kutchan": (42.90, 140.76), "Kyogoku": (42.86, 140.88),
        "Kimobetsu": (42.80, 140.94), "Rusutsu": (42.74, 140.88), "Iwanai": (42.98, 140.51),
        "Yoichi": (43.19, 140.79), "Shakotan": (43.30, 140.60), "Akaigawa": (43.08, 140.82),
        "Date (Hokkaido)": (42.47, 140.86), "Otaki (Date)": (42.67, 141.08),
        "Sobetsu": (42.55, 140.89), "Toyako": (42.55, 140.76), "Toyoura": (42.58, 140.71)},
    12: {
        "Sapporo": (43.06, 141.35), "Teine": (43.12, 141.24), "Jozankei": (42.97, 141.16),
        "Ishikari": (43.17, 141.32), "Hamamasu": (43.58, 141.39), "Muroran": (42.32, 140.97),
        "Noboribetsu": (42.41, 141.11), "Tomakomai": (42.63, 141.61), "Chitose": (42.82, 141.65),
        "Shikotsuko": (42.77, 141.40), "Shiraoi": (42.55, 141.36), "Iwamizawa": (43.20, 141.78),
        "Rumoi": (43.93, 141.64), "Wakkanai": (45.42, 141.67), "Rishiri": (45.19, 141.14),
        "Asahikawa": (43.77, 142.37), "Kamikawa": (43.85, 142.77), "Sounkyo": (43.73, 142.95),
        "Nayoro": (44.36, 142.46), "Furano": (43.34, 142.38), "Minamifurano": (43.16, 142.57),
        "Shimukappu": (42.98, 142.40), "Hidaka": (42.88, 142.44), "Urakawa": (42.17, 142.77),
        "Erimo": (42.02, 143.15), "Samani": (42.13, 142.93), "Monbetsu": (44.36, 143.35),
        "Yubetsu": (44.23, 143.62), "Engaru": (44.06, 143.53), "Maruseppu": (44.01, 143.33),
        "Shirataki": (43.88, 143.17), "Hamatombetsu": (45.12, 142.37), "Okoppe": (44.47, 143.13)},
    13: {
        "Kitami": (43.80, 143.90), "Rubeshibe": (43.79, 143.62), "Onneyu": (43.75, 143.50),
        "Tokoro": (44.12, 144.07), "Saroma": (44.02, 143.78), "Abashiri": (44.02, 144.27),
        "Shari": (43.91, 144.66), "Utoro": (44.07, 145.00), "Oketo": (43.68, 143.59),
        "Obihiro": (42.92, 143.20), "Shintoku": (43.08, 142.84), "Shimizu": (43.01, 142.88),
        "Taushubetsu (Kamishihoro)": (43.43, 143.20), "Hiroo": (42.29, 143.31),
        "Taiki": (42.50, 143.28), "Memuro": (42.91, 143.05), "Rikubetsu": (43.47, 143.75),
        "Kushiro": (42.98, 144.38), "Akan": (43.43, 144.09), "Nemuro": (43.33, 145.58),
        "Nakashibetsu": (43.55, 144.97), "Rausu": (44.02, 145.19), "Kunashiri": (44.03, 145.86),
        "Etorofu": (45.23, 147.88), "Shikotan": (43.87, 146.82)},
}
# By law between the meridians and parallels of the island zones.
_ISLAND_PARALLEL, _OKINAWA_PARALLEL = 28.0, 27.0


def zone_numbers(longitude: np.ndarray, latitude: np.ndarray) -> np.ndarray:
    """Zone, 1 to 19, of each place (degrees, JGD2011): see the module on the rule."""
    longitude, latitude = np.atleast_1d(longitude).astype(float), np.atleast_1d(latitude).astype(float)
    tree, zones = _towns()
    number = zones[tree.query(_flat(longitude, latitude))[1]]
    # Law, for Kagoshima's islands in the west: 27 to 32 N, 128.3 to 130 E, for Amami to 130 degrees 13'.
    east = np.where(latitude < 29.0, 130.0 + 13 / 60, 130.0)
    number[(latitude >= 27.0) & (latitude <= 32.0) & (longitude >= 128.3) & (longitude <= east)] = 1
    okinawa = (longitude < 133.0) & ((latitude < _OKINAWA_PARALLEL)
                                     | (latitude < _ISLAND_PARALLEL) & (longitude < 128.3))
    number[okinawa] = np.where(longitude < 126.0, 16, np.where(longitude <= 130.0, 15, 17))[okinawa]
    tokyo = (longitude >= 133.0) & (latitude < _ISLAND_PARALLEL)
    number[tokyo] = np.where(longitude < 140.5, 18, np.where(longitude <= 143.0, 14, 19))[tokyo]
    return number


def zone_epsg(zone: int) -> int:
    """EPSG code (6669 to 6687, JGD2011) of a zone, 1 to 19."""
    return _EPSG_BEFORE_ZONE_1 + zone


@lru_cache(maxsize=1)
def _towns() -> tuple[cKDTree, np.ndarray]:
    places = [(longitude, latitude, zone)
              for zone, towns in TOWNS.items() for latitude, longitude in towns.values()]
    longitudes, latitudes, zones = np.array(places).T
    return cKDTree(_flat(longitudes, latitudes)), zones.astype(int)


def _flat(longitude: np.ndarray, latitude: np.ndarray) -> np.ndarray:
    """Positions with distances near enough to true ones to find the nearest town, degrees of latitude."""
    return np.column_stack([longitude * np.cos(np.radians(36.0)), latitude])
