"""Frequent words of English that differ by few letters from other words."""

from __future__ import annotations

_WORDS = """
alarm area army aside awake aware away bath bear beat beep beer begin bell belt bend best black blank blanket block
blood board boat body bold book boot boring bread break breath breathe bring broad brother brown brush build burn
cable call calm came camera card care carry case cash catch cell chain chair chance change charge chart chat cheap
check cheer chest child chill choice choose city clean clear clip clock close cloth clothe cloud coach coat code cold
collect color come cook cool copy corner correct count court cover crash cream cross crowd curb cure dance danger dark
date dead deal dear deep desk diet dinner dirt dish doctor door dose down draw dream dress drink drive drop dust early
east edge empty enter event exit face fact fail fall farm fast feed feel fetch fever field fill film find fine finger
fire firm first fish float flood floor flow flower food foot force fork form free fresh from front fruit full game
gate gift give glad glass glove goal gold good grab grass great green greet ground group guard guess guest guide hair
hall hand handle hang hard head heal hear heart heat heavy heel held help here hide high hill hire hold hole home hook
hope horn horse host hour house hunt hurt inform kick kind kitchen knee knife knock know lady lamp land large last
late later laugh lead leaf leak lean learn leave left less letter level lift light like line link list listen live
load local lock long look loose lose loud love lower lunch mail main make male mark mask massage match matter meal
mean measure meat medicine meet melt menu message mild milk mind miss mode money month moon more most mouse mouth move
much music nail name near neat neck need nest news next nice noise north nose note nurse offer older open order oven
over pace pack page pain paint pair pale paper parent park part pass past paste path pause pay peak pick piece pill
pillow pilot pipe place plain plan plane plant plate play plug point police poor port pose post pour power praise
press print prize proof pull pump purse push quick quiet quite race rain raise rate reach react read ready real rear
relax remind report rest return rice rich ride right ring rise risk road robot rock role roll roof room root rope rose
round rule rush safe sail salt same sand save school scream screen seat second seed seek seem sell send sense serve
share sharp sheet shelf shell shift shine ship shirt shoe shop short shout show shower shut sick side sight sign
signal silent sing single sink site size skin skip sleep slice slide slip slow small smart smell smile smoke snack
snow soap sock soft soil sore sort sound soup south space spare speak speed spell spend spill spin split spoon sport
spot spray stage stair stamp stand star stare start state stay steal steam steel step stick still sting stir stock
stop store storm story stove street stress strike string strip strong stuff style sugar suit sweep sweet swim swing
switch table tablet tail take talk tall tank tape task taste teach team tear teeth tell tent test text thank their
them then there these they thick thin thing think third this those three throat throw tide tidy tile time tire toast
toilet tone tooth topic touch tour towel tower town trace track trade trail train trash tray treat tree trick trip
truck true trust tube tune turn under user view visit visitor voice vote wait wake walk wall want ward warm warn wash
waste watch water wave weak wear week weigh weight well west wheel when where which while white whole wide wife wild
window wine wing wipe wire wish with wood word work world worry wound write wrong yard year yellow young
"""
FREQUENT_WORDS = frozenset(_WORDS.split())
"""None of these is a misspelling of another word."""
